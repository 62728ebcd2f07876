# steradian_page(FOLDER CONSTANT): makes page.h of FOLDER/page.html, a text of the name CONSTANT. The line <!-- head --> stands for the
# first lines that all pages share (apps/steradian/page_head.html).
function(steradian_page folder PAGE_CONSTANT)
  set(head ${PROJECT_SOURCE_DIR}/apps/steradian/page_head.html)
  set(page ${PROJECT_SOURCE_DIR}/apps/steradian/${folder}/page.html)
  file(READ ${head} head_text)
  file(READ ${page} PAGE_TEXT)
  string(REPLACE "<!-- head -->\n" "${head_text}" PAGE_TEXT "${PAGE_TEXT}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${head} ${page})
  configure_file(${PROJECT_SOURCE_DIR}/apps/steradian/page.h.in ${PROJECT_BINARY_DIR}/apps/steradian/${folder}/page.h @ONLY)
endfunction()
