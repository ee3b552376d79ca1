# cmake -D OUT=FILE.cpp -D FOLDER=page -D HEADER=parts.h -D NAMESPACE=a::b -D "PARTS=page.html:page_html ..." -P text_to_source.cmake: writes files as
# functions that return their text.
set(source "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n")
string(REPLACE " " ";" PARTS "${PARTS}")
foreach(part ${PARTS})
  string(REPLACE ":" ";" part ${part})
  list(GET part 0 file)
  list(GET part 1 name)
  file(READ ${FOLDER}/${file} text HEX)
  # As numbers, 64 per line, because string literals have a maximum length.
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${text}")
  string(APPEND source "static constexpr unsigned char ${name}_bytes[] = {${bytes}};\n"
    "std::string_view ${name}() { return {reinterpret_cast<const char*>(${name}_bytes), sizeof ${name}_bytes}; }\n")
endforeach()
string(APPEND source "}  // namespace ${NAMESPACE}\n")
file(WRITE ${OUT} "${source}")
