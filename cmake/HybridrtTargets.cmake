# What every target of the project has in common, said once.

# One folder under core/ is one static library `hybridrt_NAME` = one line of dependencies:
#   hybridrt_library(image DEPENDS base)
#   hybridrt_library(trace DEPENDS scene PRIVATE embree)
function(hybridrt_library NAME)
  cmake_parse_arguments(ARG "" "" "DEPENDS;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  add_library(hybridrt_${NAME} STATIC ${sources})
  hybridrt_settings(hybridrt_${NAME})
  target_include_directories(hybridrt_${NAME} PUBLIC ${PROJECT_SOURCE_DIR})
  foreach(dep ${ARG_DEPENDS})
    if(TARGET hybridrt_${dep})
      target_link_libraries(hybridrt_${NAME} PUBLIC hybridrt_${dep})
    else()
      target_link_libraries(hybridrt_${NAME} PUBLIC ${dep})
    endif()
  endforeach()
  target_link_libraries(hybridrt_${NAME} PRIVATE ${ARG_PRIVATE})
endfunction()

# Compiler settings. No fused multiply-add behind our back (-ffp-contract=off), or scalar code inside
# wider SIMD targets rounds differently and pictures depend on the processor.
function(hybridrt_settings TARGET)
  target_compile_options(${TARGET} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -ffp-contract=off
                         # A failed check names core/scene/x.cpp, wherever it was built.
                         -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(${TARGET} PRIVATE -march=x86-64-v2)
  endif()
  if(HYBRIDRT_WARNINGS_AS_ERRORS)
    target_compile_options(${TARGET} PRIVATE -Werror)
  endif()
  if(HYBRIDRT_SANITIZE)
    target_compile_options(${TARGET} PRIVATE -fsanitize=${HYBRIDRT_SANITIZE} -fno-sanitize-recover=all
                                             -fno-omit-frame-pointer)
    target_link_options(${TARGET} PRIVATE -fsanitize=${HYBRIDRT_SANITIZE})
  endif()
endfunction()
