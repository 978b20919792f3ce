# Defines SuiteSparse::SPQR, SuiteSparse::CHOLMOD, SuiteSparse::AMD and SuiteSparse::KLU. Debian's SuiteSparse 5.12 ships no usable CMake package for SPQR.
find_path(SuiteSparse_INCLUDE_DIR SuiteSparseQR.hpp PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_SPQR_LIBRARY spqr)
find_library(SuiteSparse_CHOLMOD_LIBRARY cholmod)
find_library(SuiteSparse_AMD_LIBRARY amd)
find_library(SuiteSparse_KLU_LIBRARY klu)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse
  REQUIRED_VARS SuiteSparse_SPQR_LIBRARY SuiteSparse_CHOLMOD_LIBRARY SuiteSparse_AMD_LIBRARY SuiteSparse_KLU_LIBRARY
    SuiteSparse_INCLUDE_DIR)
if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::SPQR)
  foreach(library SPQR CHOLMOD AMD KLU)
    add_library(SuiteSparse::${library} UNKNOWN IMPORTED)
    set_target_properties(SuiteSparse::${library} PROPERTIES IMPORTED_LOCATION "${SuiteSparse_${library}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
  endforeach()
  set_target_properties(SuiteSparse::SPQR PROPERTIES INTERFACE_LINK_LIBRARIES SuiteSparse::CHOLMOD)
endif()
mark_as_advanced(SuiteSparse_KLU_LIBRARY SuiteSparse_INCLUDE_DIR SuiteSparse_SPQR_LIBRARY SuiteSparse_CHOLMOD_LIBRARY SuiteSparse_AMD_LIBRARY)
