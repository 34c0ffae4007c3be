#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/internal/controller_program.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

/// The words of RAPID (Technical reference manual: RAPID kernel) and of KRL that name no program.
constexpr std::string_view rapid_words =
    " ALIAS AND BACKWARD CASE CONNECT CONST DEFAULT DIV DO ELSE ELSEIF ENDFOR ENDFUNC ENDIF "
    "ENDMODULE ENDPROC ENDRECORD ENDTEST ENDTRAP ENDWHILE ERROR EXIT FALSE FOR FROM FUNC GOTO IF "
    "INOUT LOCAL MOD MODULE NOSTEPIN NOT NOVIEW OR PERS PROC RAISE READONLY RECORD RETRY RETURN "
    "STEP SYSMODULE TASK TEST THEN TO TRAP TRUE TRYNEXT UNDO VAR VIEWONLY WHILE WITH XOR ";
constexpr std::string_view krl_words =
    " AND ANIN ANOUT BOOL BRAKE B_AND B_EXOR B_NOT B_OR CASE CAST_FROM CAST_TO CHANNEL CHAR CIRC "
    "CIRC_REL CONFIRM CONST CONST_VEL CONTINUE DECL DEF DEFAULT DEFDAT DEFFCT DELAY DIGIN DISTANCE "
    "DO ELSE END ENDDAT ENDFCT ENDFOR ENDIF ENDLOOP ENDSPLINE ENDSWITCH ENDWHILE ENUM EXIT EXOR "
    "EXT EXTFCT FALSE FOR GLOBAL GOTO HALT IF IMPORT INT INTERRUPT IS LIN LIN_REL LOOP MAXIMUM "
    "MINIMUM NOT OFF ON OR PATH PRIO PTP PTP_REL PTP_SPLINE PUBLIC PULSE REAL REPEAT RESUME RETURN "
    "SCIRC SEC SIGNAL SLIN SPL SPLINE SPTP STEP STRUC SWITCH SWRITE THEN TIME_BLOCK TO TRIGGER "
    "TRUE UNTIL WAIT WHEN WHILE ";

/// Refuses a name that is no identifier, is too long or has a meaning in the language.
void check_identifier(const std::string& name, const char* language, std::size_t longest,
                      std::string_view reserved) {
  std::string upper = name;
  bool valid = !name.empty() && name.size() <= longest;
  for (char& c : upper) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = (c >= '0' && c <= '9') || c == '_';
    valid = valid && (letter || (digit && &c != upper.data()));
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  }
  if (valid && reserved.find(" " + upper + " ") == std::string_view::npos) return;
  throw Error(in_quotes(name) + " cannot name a program of " + language +
              ": a letter, then letters, digits and _, at most " + std::to_string(longest) +
              " characters, and no word of the language");
}

/// Whether the arm must stop at sample k: at the ends, before and after a pause, and where the
/// velocity is zero.
bool stops_at(const Trajectory& samples, std::size_t k) {
  if (k == 0 || k + 1 == samples.size()) return true;
  if (!samples.velocities.empty() && samples.velocities[k].isZero(0)) return true;
  return samples.positions[k] == samples.positions[k - 1] ||
         samples.positions[k] == samples.positions[k + 1];
}

bool pauses_before(const Trajectory& samples, std::size_t k) {
  return k > 0 && samples.positions[k] == samples.positions[k - 1];
}

/// The time from the sample before, to the microsecond, at least a millisecond.
std::string time_to(const Trajectory& samples, std::size_t k) {
  return fixed_point(std::max(samples.times[k] - samples.times[k - 1], 1e-3), 6);
}

}  // namespace

std::string commented(const std::vector<std::string>& lines, const char* prefix) {
  std::string text;
  for (const std::string& line : lines) text += prefix + line + '\n';
  return text;
}

std::string plain(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return fixed_point(std::abs(value) * scale < 0.5 ? 0.0 : value, decimals);
}

std::string listed_numbers(const Configuration& values, int decimals) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : ",") + plain(value, decimals);
  }
  return text;
}

std::string radians_of(const Configuration& q) { return "[" + listed_numbers(q, 9) + "]"; }

void check_rapid_name(const std::string& name) { check_identifier(name, "RAPID", 27, rapid_words); }

void check_krl_name(const std::string& name) { check_identifier(name, "KRL", 24, krl_words); }

std::string rapid_axes(const Configuration& q) {
  const Configuration degrees = degrees_per_radian * q;
  return "[[" + listed_numbers(degrees, 6) + "],[9E9,9E9,9E9,9E9,9E9,9E9]]";
}

std::string krl_axes(const Configuration& q) {
  std::string axes;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    axes +=
        (i == 0 ? "A" : ",A") + std::to_string(i + 1) + " " + plain(degrees_per_radian * q[i], 6);
  }
  return "{" + axes + "}";
}

std::string urscript_approach(const Configuration& first) {
  return "  def farthest(a, b):\n"
         "    local far = 0.0\n"
         "    local i = 0\n"
         "    while i < 6:\n"
         "      if norm(a[i] - b[i]) > far:\n"
         "        far = norm(a[i] - b[i])\n"
         "      end\n"
         "      i = i + 1\n"
         "    end\n"
         "    return far\n"
         "  end\n"
         "  first = " +
         radians_of(first) +
         "\n"
         "  if farthest(get_actual_joint_positions(), first) > 0.1:\n"
         "    popup(\"The arm moves to the first sample. Is that motion free of obstacles?\", "
         "title=\"Beeline\", warning=True, blocking=True)\n"
         "  end\n"
         "  movej(first, a=0.5, v=0.25)\n"
         "  if farthest(get_actual_joint_positions(), first) > 0.001:\n"
         "    popup(\"The arm is not at the first sample.\", title=\"Beeline\", error=True, "
         "blocking=True)\n"
         "    halt\n"
         "  end\n";
}

std::string urscript_program(const ProgramSource& source, double period) {
  const std::vector<Configuration>& positions = source.samples.positions;
  const std::string tracking = ", lookahead_time=0.1, gain=300)\n";
  std::string text = commented(source.comments, "# ");
  text += "def beeline_motion():\n";
  if (source.frames.has_tool()) text += urscript_tool(source.frames);
  text += urscript_approach(positions.front());
  const std::string step = ", t=" + fixed_point(period, 3) + tracking;
  for (const Configuration& q : positions) text += "  servoj(" + radians_of(q) + step;
  // servoj() follows with a delay: the arm reaches the last setpoint while it is held.
  text += "  servoj(" + radians_of(positions.back()) + ", t=0.200" + tracking;
  return text + "  stopj(2.0)\nend\n";
}

std::string rapid_program(const ProgramSource& source) {
  check_rapid_name(source.name);
  const Trajectory& samples = source.samples;
  std::string text = "MODULE " + source.name + "\n" + commented(source.comments, "  ! ") +
                     rapid_declarations(source.frames, source.name) + "  PROC play_" + source.name +
                     "()\n";
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (pauses_before(samples, k)) {
      text += "    WaitTime " + time_to(samples, k) + ";\n";
      continue;
    }
    text += "    MoveAbsJ " + rapid_axes(samples.positions[k]) + "\\NoEOffs,v100" +
            (k == 0 ? "" : "\\T:=" + time_to(samples, k)) +
            (stops_at(samples, k) ? ",fine," : ",z1,") + rapid_tool(source.frames, source.name) +
            ";\n";
  }
  return text + "  ENDPROC\nENDMODULE\n";
}

std::string krl_program(const ProgramSource& source) {
  check_krl_name(source.name);
  const Trajectory& samples = source.samples;
  std::string text = "DEF " + source.name + "()\n" + commented(source.comments, "; ") +
                     "INT I\n"
                     "BAS(#INITMOV,0)\n" +
                     (source.frames.has_tool() ? krl_tool(source.frames) : "") +
                     "FOR I=1 TO 6\n"
                     "  $VEL_AXIS[I]=10\n"
                     "  $ACC_AXIS[I]=50\n"
                     "ENDFOR\n"
                     "$APO.CPTP=50\n";
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (pauses_before(samples, k)) {
      text += "WAIT SEC " + time_to(samples, k) + "\n";
      continue;
    }
    text += "PTP " + krl_axes(samples.positions[k]) + (stops_at(samples, k) ? "\n" : " C_PTP\n");
  }
  return text + "END\n";
}

}  // namespace beeline::internal
