#pragma once

/// What both WebAssembly modules have. Buffers hold float64 and lie in the module's memory. No
/// exception leaves a module: a function that fails returns a negative number, and beeline_error()
/// says why, in the words of the command line.

extern "C" {

/// Returns memory for `count` numbers, or null if there is none.
double* beeline_allocate(int count);
void beeline_release(void* memory);

/// The message of the last call that failed; valid until the next call.
const char* beeline_error();
}
