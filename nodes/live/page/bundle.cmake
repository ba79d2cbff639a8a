# SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
# SPDX-License-Identifier: BSD-3-Clause

# cmake -DOUT=page.html -P bundle.cmake: writes the page as one file. The JavaScript modules are joined to one
# script without their imports and the word `export`. All top-level names of the modules must therefore
# differ. A module may import only from modules that precede it in the list below. Comment lines and
# indentation are removed, because they are a fifth of 110 kB and nobody reads them in a browser.
cmake_minimum_required(VERSION 3.22)
set(modules vectors palette convex polygon batch round shapes messages connection history camera shaders
            renderer scene picking elements notices overlay objects plots settings view controls page main)

# Texts are always quoted, because CMake treats `;`, `[` and `]` in unquoted texts as list syntax.
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

# Write the file only if its content changes, so that files that depend on it are not built again.
if(EXISTS "${OUT}")
  file(READ "${OUT}" before)
endif()
if(NOT "${before}" STREQUAL "${page}")
  file(WRITE "${OUT}" "${page}")
endif()
