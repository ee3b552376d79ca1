# Installs the headers of FOLDERS below INCLUDES/strata. In the sources they name each other from the repository's root; installed ones
# name each other as <strata/...>, so that a program's include path needs one folder, and no folder of its own is mistaken for ours.
set(place "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${INCLUDES}/strata")
foreach(folder IN LISTS FOLDERS)
  file(GLOB_RECURSE headers RELATIVE ${SOURCE} ${SOURCE}/${folder}/*.h)
  foreach(header IN LISTS headers)
    file(READ ${SOURCE}/${header} text)
    string(REGEX REPLACE "#include \"((rasterizer|pipeline|peeling|scenes|tools)/[^\"]+)\"" "#include <strata/\\1>" text "${text}")
    string(REGEX REPLACE "#include \"(strata/[^\"]+)\"" "#include <\\1>" text "${text}")
    string(REGEX REPLACE "^tools/library/strata/" "" installed ${header})
    file(CONFIGURE OUTPUT ${place}/${installed} CONTENT "${text}" @ONLY)
  endforeach()
endforeach()
