# Every library comes from a Debian 12 package; run.sh and test.sh install what is missing.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(SuiteSparse REQUIRED MODULE)
find_package(GLPK 5.0 REQUIRED MODULE)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(Threads REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo cairo-svg)

# Debian's own interpreter carries h5py and matplotlib, whichever python3 comes first in PATH.
find_program(INDET_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(NOT INDET_PYTHON)
  find_program(INDET_PYTHON NAMES python3)
endif()
