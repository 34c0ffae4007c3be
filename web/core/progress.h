#pragma once

/// Calls the module's function `progress` with the fraction computed, while the core computes.
void report_progress(double fraction);
