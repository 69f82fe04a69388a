# culet_unity(target files): one translation unit for so many files of a folder: what they include is read and compiled
# once. A file that Highway
# compiles for every instruction set stays alone, and whatever has SKIP_UNITY_BUILD_INCLUSION.
function(culet_unity target files)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "^${CMAKE_CURRENT_BINARY_DIR}")
  foreach(source ${sources})
    file(STRINGS ${source} for_each_target REGEX "hwy/foreach_target.h")
    if(for_each_target)
      continue()
    endif()
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "in_${folder}" folder)
    math(EXPR ${folder} "${${folder}} + 1")
    math(EXPR group "(${${folder}} - 1) / ${files}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CULET_UNITY} UNITY_BUILD_MODE GROUP)
endfunction()
