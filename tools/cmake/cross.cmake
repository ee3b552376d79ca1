# A toolchain of Debian's cross compilers, for tools/cross.sh: -DSTRATA_MACHINE=aarch64, s390x or riscv64. Programs are linked statically, so that
# qemu-user needs no libraries of that processor.
set(CMAKE_SYSTEM_NAME Linux)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES STRATA_MACHINE)
set(CMAKE_SYSTEM_PROCESSOR ${STRATA_MACHINE})
set(CMAKE_CXX_COMPILER ${STRATA_MACHINE}-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${STRATA_MACHINE}-static)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
