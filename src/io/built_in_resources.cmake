# Writes built_in_presets.inc and built_in_lessons.inc into FASCICLE_RESOURCE_FOLDER: the files of resources/ as text, in the
# order in which they are offered. A change of one of them runs CMake again.
function(fascicle_embed folder)
  set(rows "")
  foreach(name ${ARGN})
    set(file ${CMAKE_CURRENT_LIST_DIR}/../../resources/${folder}/${name}.json)
    file(READ ${file} text)
    string(APPEND rows "{\"${name}.json\", R\"json(${text})json\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  file(CONFIGURE OUTPUT ${FASCICLE_RESOURCE_FOLDER}/built_in_${folder}.inc CONTENT "${rows}" @ONLY)
endfunction()
fascicle_embed(presets paper soft stiff isotropic)
fascicle_embed(lessons volume local-shape anisotropy contact moment-arm quiz)
