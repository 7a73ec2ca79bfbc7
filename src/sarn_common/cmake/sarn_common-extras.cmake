# SPDX-License-Identifier: BSD-3-Clause
# Compiler settings of every C++ target of this workspace, and how its packages link and test.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release by default: planner and simulator are built for speed" FORCE)
endif()
# Other compilers than the one that is checked with warn of other things, which keeps nobody from building.
set(werror OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
  set(werror ON)
endif()
option(SARN_WERROR "Treat warnings as errors" ${werror})
set(SARN_SANITIZE "" CACHE STRING "Sanitizers, for example address,undefined; empty for none")

function(sarn_target_defaults target)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wno-psabi)
  if(SARN_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SARN_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${SARN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${SARN_SANITIZE})
  endif()
endfunction()

# Target names of other packages' libraries. A build of the whole workspace has them; in a build of one package alone
# (catkin build) catkin knows only files, PACKAGE_LIBRARIES: here each gets the target that its package calls it.
# sarn_import_libraries(packages...), after find_package.
function(sarn_import_libraries)
  foreach(package ${ARGN})
    set(own ${${package}_LIBRARIES})
    list(FILTER own INCLUDE REGEX "/lib${package}[a-z_]*\\.so$")
    set(others ${${package}_LIBRARIES})
    if(own)
      list(REMOVE_ITEM others ${own})
    endif()
    foreach(file ${own})
      get_filename_component(name ${file} NAME_WE)
      string(REGEX REPLACE "^lib" "" name ${name})
      if(NOT TARGET ${name})
        add_library(${name} SHARED IMPORTED)
        set_target_properties(${name} PROPERTIES
          IMPORTED_LOCATION ${file}
          IMPORTED_NO_SONAME TRUE
          INTERFACE_INCLUDE_DIRECTORIES "${${package}_INCLUDE_DIRS}"
          INTERFACE_LINK_LIBRARIES "${others}"
          INTERFACE_LINK_OPTIONS "LINKER:--as-needed")
        if(NOT name STREQUAL package)
          set_property(TARGET ${name} APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${package})
        endif()
      endif()
    endforeach()
  endforeach()
endfunction()

# gtest of a core: no roscore. sarn_add_gtest(name sources... LIBRARIES libs...)
function(sarn_add_gtest name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  catkin_add_gtest(${name} ${ARG_UNPARSED_ARGUMENTS} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  if(TARGET ${name})
    sarn_target_defaults(${name})
    set(main GTest::gtest_main)
    if(NOT TARGET GTest::gtest_main)  # Ubuntu 20.04: CMake knows it since 3.20
      set(main ${GTEST_MAIN_LIBRARIES})
    endif()
    target_link_libraries(${name} ${ARG_LIBRARIES} ${main})
  endif()
endfunction()
