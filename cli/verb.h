#pragma once

#include <CLI/App.hpp>
#include <functional>

/// What the shell is told. 0 yes; 1 the computed answer is no; 2 bad usage; 3 bad input file.
enum class Exit { yes = 0, no = 1, usage = 2, file = 3 };

/// A verb declares its options on its own subcommand and returns what to do once they are parsed.
/// stdout carries the answer, stderr reasons, warnings and progress.
using Run = std::function<Exit()>;

Run declare_arms(CLI::App& verb);
Run declare_show(CLI::App& verb);
Run declare_fk(CLI::App& verb);
Run declare_jacobian(CLI::App& verb);
Run declare_ik(CLI::App& verb);
Run declare_batch(CLI::App& verb);
Run declare_move(CLI::App& verb);
Run declare_line(CLI::App& verb);
Run declare_check(CLI::App& verb);
Run declare_replay(CLI::App& verb);
Run declare_diff(CLI::App& verb);
Run declare_time(CLI::App& verb);
Run declare_draw(CLI::App& verb);
Run declare_figure(CLI::App& verb);
