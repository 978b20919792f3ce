# indet_add_stage(NAME [FOLDER dir] SOURCES ... DEPENDS stages... [LIBRARIES ...] [PRIVATE_LIBRARIES ...])
#
# One static library a folder. Each stage has an include root of its own that holds nothing but
# indet/<stage>, and sees only the roots of the stages it depends on: a header of a later stage
# cannot even be found, so data flows one way.
function(indet_add_stage NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  set(root ${CMAKE_BINARY_DIR}/include/${NAME})
  file(MAKE_DIRECTORY ${root}/indet)
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/indet/${NAME} SYMBOLIC)
  add_library(indet_${NAME} STATIC ${ARG_SOURCES})
  add_library(indet::${NAME} ALIAS indet_${NAME})
  set_target_properties(indet_${NAME} PROPERTIES EXPORT_NAME ${NAME} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(indet_${NAME} PUBLIC
    $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM ARG_DEPENDS PREPEND indet::)
  target_link_libraries(indet_${NAME}
    PUBLIC ${ARG_DEPENDS} ${ARG_LIBRARIES}
    PRIVATE $<BUILD_INTERFACE:indet_options> ${ARG_PRIVATE_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY INDET_STAGES indet_${NAME})
  set_property(GLOBAL APPEND PROPERTY INDET_STAGE_FOLDERS ${CMAKE_CURRENT_SOURCE_DIR}:${NAME})
endfunction()
