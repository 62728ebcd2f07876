// Compiled where STERADIAN_WINDOW is OFF.
#include "../viewer/window/window.h"
#include "steradian/error.h"

namespace steradian::view {

void run_window(const WindowOptions&) {
  throw Error("view", "this program was built without a window", "build it with -DSTERADIAN_WINDOW=ON, as ./dev build does");
}

}  // namespace steradian::view
