# cmake -DNAME=extremes -DSPIRV=extremes.spv -DOUT=extremes.cpp -P embed.cmake: writes a shader's SPIR-V as the C++
# function NAME_code(). SPIR-V consists of words of 32 bits, which glslc writes with the lowest byte first.
file(READ ${SPIRV} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
string(REGEX REPLACE "((0x........,){8})" "\\1\n" words "${words}")
file(WRITE ${OUT} "#include \"shader_code.h\"\n\nnamespace {\nconst std::uint32_t ${NAME}_words[] = {${words}};\n}\n\n"
  "pcl_bv::detail::ShaderCode pcl_bv::detail::${NAME}_code() { return {${NAME}_words, sizeof ${NAME}_words}; }\n")
