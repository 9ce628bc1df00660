# Finds the three OpenCV modules the project uses, one by one: opencv_core, opencv_imgproc, opencv_ml.
# OpenCV's own CMake package comes with all modules (190 Debian packages, and highgui, which drags
# Qt 5 into a process); the three -dev packages alone are 11. Headers are SYSTEM: they warn in C++20.
find_path(OpenCVModules_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(OpenCVModules_vars OpenCVModules_INCLUDE_DIR)
foreach(module core imgproc ml)
  find_library(OpenCVModules_${module}_LIBRARY opencv_${module})
  list(APPEND OpenCVModules_vars OpenCVModules_${module}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVModules REQUIRED_VARS ${OpenCVModules_vars})
if(OpenCVModules_FOUND)
  foreach(module core imgproc ml)
    if(NOT TARGET opencv_${module})
      add_library(opencv_${module} SHARED IMPORTED)
      set_target_properties(opencv_${module} PROPERTIES
        IMPORTED_LOCATION ${OpenCVModules_${module}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenCVModules_INCLUDE_DIR})
    endif()
  endforeach()
  target_link_libraries(opencv_imgproc INTERFACE opencv_core)
  target_link_libraries(opencv_ml INTERFACE opencv_core)
endif()
mark_as_advanced(${OpenCVModules_vars})
