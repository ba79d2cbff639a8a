# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause

# cmake -DOUT=page.html -P bundle.cmake: the page in one file. Its modules stand one after the other in one script,
# without imports and the word `export`, so their top-level names differ; in the order below, each imports only from those
# above it. Lines of comments and indentation stay behind, too: they are a fifth of 110 kB that nobody reads in a browser.
cmake_minimum_required(VERSION 3.22)
set(modules vectors palette convex batch round shapes messages connection history camera shaders renderer scene picking
            elements notices overlay objects plots settings view controls page main)

# Texts are always quoted: unquoted, CMake would take `;`, `[` and `]` for a list's.
set(script "")
set(above "")
foreach(module ${modules})
  file(READ "${CMAKE_CURRENT_LIST_DIR}/${module}.js" text)
  set(text "\n${text}")
  string(REGEX MATCHALL "\nimport [^\n;]* from \"./[a-z]+.js\"" imports "${text}")
  foreach(import IN LISTS imports)
    string(REGEX REPLACE ".*\"./([a-z]+).js\"" "\\1" name "${import}")
    if(NOT name IN_LIST above)
      message(FATAL_ERROR "${module}.js imports ${name}.js, which stands below it in bundle.cmake")
    endif()
  endforeach()
  list(APPEND above ${module})
  string(REGEX REPLACE "\nimport [^\n]*" "" text "${text}")
  string(REPLACE "\nexport " "\n" text "${text}")
  string(REGEX REPLACE "\n *//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "\n +" "\n" text "${text}")
  string(APPEND script "${text}")
endforeach()
if(script MATCHES "\n(import|export) |</script")
  message(FATAL_ERROR "The script holds what it must not: ${CMAKE_MATCH_0}")
endif()

file(READ "${CMAKE_CURRENT_LIST_DIR}/index.html" page)
file(READ "${CMAKE_CURRENT_LIST_DIR}/style.css" style)
set(style_link "<link rel=\"stylesheet\" href=\"style.css\">")
set(script_link "<script type=\"module\" src=\"main.js\"></script>")
foreach(place "${style_link}" "${script_link}" "\n<!-- data -->\n")
  string(FIND "${page}" "${place}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "index.html lacks ${place}")
  endif()
endforeach()
string(REPLACE "${style_link}" "<style>\n${style}</style>" page "${page}")
string(REPLACE "${script_link}" "<script type=\"module\">${script}</script>" page "${page}")

# Only when it differs, so that what is made of it is not made again.
if(EXISTS "${OUT}")
  file(READ "${OUT}" before)
endif()
if(NOT "${before}" STREQUAL "${page}")
  file(WRITE "${OUT}" "${page}")
endif()
