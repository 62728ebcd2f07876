// Stage: the content of a window that a user edits, a scene in space or a drawing of the plane. Pixels count from the upper left corner.
#pragma once

#include <string>

#include "steradian/tone.h"
#include "steradian/vector2.h"

namespace steradian::view {

enum class PointerButton { left, middle, right };

class Stage {
 public:
  Stage() = default;
  virtual ~Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Looks for a new picture, and requests one if something has changed; never waits. True if there is a new one.
  virtual bool update() = 0;
  virtual bool settled() const = 0;            // the picture is the final one of all requests
  virtual void wait_until_settled() = 0;       // for scripts and tests
  virtual const Picture& picture() const = 0;  // without pixels until the first is done

  virtual void resize(int width, int height) = 0;
  virtual void press(PointerButton button, bool shift, Vec2d at) = 0;
  virtual void drag(Vec2d to) = 0;
  virtual void release(Vec2d at) = 0;
  virtual bool dragging() const = 0;
  virtual void wheel(double steps, Vec2d at) = 0;
  virtual void fly(double right, double up, double forward) = 0;
  // Between true and false pictures are rendered fast, and all changes are one step of undo.
  virtual void set_moving(bool moving) = 0;

  // For animated content: its duration [s], 0 if nothing is animated, and the displayed moment. After the end it restarts, or continues if
  // it has no end.
  virtual double duration() const = 0;
  virtual double time() const = 0;
  virtual void set_time(double seconds) = 0;

  virtual void remove_selected() = 0;
  virtual void deselect() = 0;
  virtual void select_named(const std::string& name) = 0;  // the first of that name; nothing if there is none
  virtual void undo() = 0;
  virtual void redo() = 0;
  virtual void frame_selected() = 0;
  virtual void reset_camera() = 0;

  virtual const std::string& path() const = 0;
  virtual bool unsaved() const = 0;       // something was changed since the file was read or saved
  virtual bool file_changed() const = 0;  // the file changed since it was read or saved
  virtual void reload() = 0;
  virtual void save_scene(const std::string& path) = 0;
  virtual void save_picture(const std::string& path, float exposure_stops, ToneCurve curve) = 0;  // waits for the final picture

  const std::string& message() const { return message_; }  // the last problem; empty: none
  void say(std::string message) { message_ = std::move(message); }

 private:
  std::string message_;
};

}  // namespace steradian::view
