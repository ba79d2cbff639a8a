# cmake -DPAGE=page.html -DOUT=page.cpp -P embed.cmake: writes the page as a C++ function. The bytes of the
# page are written as numbers, because a raw string literal would end where the page contains its closing
# delimiter.
file(READ ${PAGE} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "((0x..,){24})" "\\1\n" bytes "${bytes}")
file(WRITE ${OUT} "#include \"page.h\"\n\nnamespace {\nconst unsigned char page[] = {${bytes}};\n}\n\n"
  "std::string_view pcl_bv::detail::live_page() { return {reinterpret_cast<const char*>(page), sizeof page}; }\n")
