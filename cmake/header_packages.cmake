# steradian_header_packages(FOLDER NAME...): a folder with links to packages of this machine that are headers alone, as /usr/include/NAME.
# A compiler for another machine must not search /usr/include, which has the headers of this machine's own libraries, too.
function(steradian_header_packages folder)
  file(MAKE_DIRECTORY ${folder})
  foreach(name ${ARGN})
    if(NOT EXISTS /usr/include/${name})
      message(FATAL_ERROR "there is no /usr/include/${name}: install its Debian package, or run ./dev setup --all")
    endif()
    file(CREATE_LINK /usr/include/${name} ${folder}/${name} SYMBOLIC)
  endforeach()
endfunction()
