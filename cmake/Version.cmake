# Writes OUTPUT, a C++ file with what `hybridrt --version` says, when the commit has changed. Run as a script:
# cmake -DOUTPUT=… -DSOURCE=… -DVERSION=… -DCOMPILER=… -P Version.cmake
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
set(code "#include \"cli/version.h\"\n\nnamespace hybridrt::cli {\n\
const char* const kVersion = \"${VERSION}\";\nconst char* const kCommit = \"${commit}\";\n\
const char* const kCompiler = \"${COMPILER}\";\n}  // namespace hybridrt::cli\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${old}" STREQUAL "${code}")
  file(WRITE ${OUTPUT} "${code}")
endif()
