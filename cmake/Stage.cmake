# indet_add_stage(NAME SOURCES ... DEPENDS stages... [LIBRARIES ...] [PRIVATE_LIBRARIES ...] [INTERNAL] [LIGHT])
#
# One static library a folder. The include root is the repository, so that the path of a file is the path of its
# include. DEPENDS names the stages whose headers the folder includes, all of them and no others, and no stage may lead
# back to itself: tests/stages compares the includes with this list. INTERNAL: a part of the program, not installed.
# LIGHT: it computes little, and is compiled with little optimisation.
function(indet_add_stage NAME)
  cmake_parse_arguments(ARG "INTERNAL;LIGHT" "" "SOURCES;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  add_library(indet_${NAME} STATIC ${ARG_SOURCES})
  add_library(indet::${NAME} ALIAS indet_${NAME})
  set_target_properties(indet_${NAME} PROPERTIES EXPORT_NAME ${NAME} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(indet_${NAME} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_DEPENDS PREPEND indet::)
  target_link_libraries(indet_${NAME}
    PUBLIC ${ARG_DEPENDS} ${ARG_LIBRARIES}
    PRIVATE $<BUILD_INTERFACE:indet_options> ${ARG_PRIVATE_LIBRARIES})
  if(ARG_LIGHT)
    indet_optimise_little(indet_${NAME})
  endif()
  if(NOT ARG_INTERNAL)
    set_property(GLOBAL APPEND PROPERTY INDET_STAGES indet_${NAME})
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    set_property(GLOBAL APPEND PROPERTY INDET_STAGE_FOLDERS ${folder})
  endif()
endfunction()
