# Installs the headers of FOLDERS in INCLUDES/strata. In the sources they include each other by their path in the repository; installed ones by
# <strata/...>, so that a program's include path needs one folder, and no folder of the program is confused with ours.
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
