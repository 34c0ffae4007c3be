// Why this file exists: the wheel is built on Debian 12 (glibc 2.36) and shall load where glibc
// is 2.34, as on RHEL 9. std::hypot is the only function it calls that has a newer version there,
// of glibc 2.35, and the linker takes the newest. With -Wl,--wrap=hypot (python/CMakeLists.txt)
// each call of hypot is one of __wrap_hypot, which calls the first version, which every glibc on
// x86-64 has. Elsewhere the first version has another name: CMake leaves this file and the option
// out, and the wheel then needs glibc 2.35. To be deleted when 2.34 no longer counts.
// tests/python/packaging_test.py checks the versions that the module needs.
extern "C" {
__asm__(".symver beeline_hypot, hypot@GLIBC_2.2.5");
double beeline_hypot(double x, double y);
double __wrap_hypot(double x, double y);  // NOLINT(readability-identifier-naming)
double __wrap_hypot(double x, double y) { return beeline_hypot(x, y); }
}
