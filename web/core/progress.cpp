#include "progress.h"

#ifdef __EMSCRIPTEN__
#include <emscripten.h>

EM_JS(void, call_progress, (double fraction), { Module["progress"](fraction); });
#else  // clang-tidy, which has no header of Emscripten
static void call_progress(double) {}
#endif

void report_progress(double fraction) { call_progress(fraction); }
