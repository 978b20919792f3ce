# Defines SuiteSparse::SPQR (with CHOLMOD), SuiteSparse::AMD and SuiteSparse::KLU. Debian's SuiteSparse 5.12 ships no usable CMake package for SPQR.
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
  add_library(SuiteSparse::SPQR UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::SPQR PROPERTIES IMPORTED_LOCATION "${SuiteSparse_SPQR_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${SuiteSparse_CHOLMOD_LIBRARY}")
  add_library(SuiteSparse::AMD UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::AMD PROPERTIES IMPORTED_LOCATION "${SuiteSparse_AMD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
  add_library(SuiteSparse::KLU UNKNOWN IMPORTED)
  set_target_properties(SuiteSparse::KLU PROPERTIES IMPORTED_LOCATION "${SuiteSparse_KLU_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
endif()
mark_as_advanced(SuiteSparse_KLU_LIBRARY SuiteSparse_INCLUDE_DIR SuiteSparse_SPQR_LIBRARY SuiteSparse_CHOLMOD_LIBRARY SuiteSparse_AMD_LIBRARY)
