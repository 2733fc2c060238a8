# Turns the text files FILES into OUTPUT, a C++ file defining hybridrt::gl::embedded_shaders().
# Run as a script: cmake -DOUTPUT=... "-DFILES=a;b" -P EmbedShaders.cmake
set(code "#include \"core/gl/program.h\"\n\nnamespace hybridrt::gl {\nShaderSources embedded_shaders() {\n  return {\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND code "      {\"${name}\", R\"shader(${text})shader\"},\n")
endforeach()
string(APPEND code "  };\n}\n}  // namespace hybridrt::gl\n")
file(WRITE ${OUTPUT} "${code}")
