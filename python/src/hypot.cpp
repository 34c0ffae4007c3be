// glibc 2.35 has a second version of hypot(), which a module linked there would need. The first
// one, of every glibc on x86-64, lets the module load from glibc 2.33 on. The linker's --wrap=hypot
// makes each call one of __wrap_hypot.
extern "C" {
__asm__(".symver beeline_hypot, hypot@GLIBC_2.2.5");
double beeline_hypot(double x, double y);
double __wrap_hypot(double x, double y);  // NOLINT(readability-identifier-naming)
double __wrap_hypot(double x, double y) { return beeline_hypot(x, y); }
}
