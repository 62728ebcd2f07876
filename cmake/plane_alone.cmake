# steradian_plane_alone(LIST ROOT): the sources of the plane without packages: the package for browsers, and tests on other machines. They
# read drawings from a text by the headers of web/steradian-plane/source/packages. There are no files, no animations and no fonts.
function(steradian_plane_alone list root)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${root}/source/plane/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$|/drawing\\.cpp$|/light_field\\.cpp$|/text/(without_)?fonts\\.cpp$|/svg/(animate|file|timing|style/values)\\.cpp$")
  set(${list} ${sources} PARENT_SCOPE)
endfunction()
