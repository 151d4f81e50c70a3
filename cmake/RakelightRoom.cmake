# SPDX-FileCopyrightText: 2026 The Rakelight authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# rakelight_room(NAME SOURCES ... [PUBLIC targets] [PRIVATE targets])
# A room is a folder, a library rakelight::NAME and one header to read first.

add_library(rakelight_warnings INTERFACE)
target_compile_options(rakelight_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
  $<$<BOOL:${RAKELIGHT_STRICT}>:-Werror>)
if(RAKELIGHT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(RAKELIGHT_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

function(rakelight_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;PUBLIC;PRIVATE")
  add_library(rakelight_${name} STATIC ${room_SOURCES})
  add_library(rakelight::${name} ALIAS rakelight_${name})
  target_compile_features(rakelight_${name} PUBLIC cxx_std_17)
  set_target_properties(rakelight_${name} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
  target_include_directories(rakelight_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/rakelight>)
  target_link_libraries(rakelight_${name}
    PUBLIC ${room_PUBLIC} PRIVATE ${room_PRIVATE} $<BUILD_INTERFACE:rakelight_warnings>)
  set_property(GLOBAL APPEND PROPERTY RAKELIGHT_ROOMS ${name})
endfunction()
