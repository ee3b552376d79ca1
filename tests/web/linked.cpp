// tests/web/linked.cpp - the program of the test web.linked: all sources of the page, so that the linker finds a source
// that their list lacks.
int main() { return 0; }
