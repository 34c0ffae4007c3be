// Certifies straight joint motions of 1 rad ("edges") of an arm in many scenes, beside coal, which
// samples the same edges every 0.05 rad, and compares the answers with a referee: the least of
// coal's distances along the edge, whose ten least samples are refined. Prints tables in Markdown,
// microseconds of CPU, and writes the edges and answers as lines of JSON for hpp_edges.py. Fails if
// coal refutes an answer.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include <beeline/certificate/clearance.h>
#include <beeline/io/text/scene.h>

#include "../inverse/timing.h"
#include "coal_scene.h"
#include "problems.h"

namespace beeline::bench {
namespace {

struct Options {
  std::string arm, problems, out;
  std::size_t edges = 5, scenes = 1000, boxes = 20;
  int refine = 50, passes = 3;
  unsigned seed = 1;
  double clearance = 1e-3;
};

constexpr int samples = 20;  // intervals of an edge between coal's samples: 0.05 rad

/// An edge with all answers.
struct Answer {
  Edge edge;
  ClearanceProof proof;
  double certified = 0;                      ///< median time, µs
  bool sampled = false;                      ///< whether coal finds a collision
  double sampling = 0;                       ///< median time, µs
  double least = 0, least_at = 0;            ///< the referee's distance, m, and its place
  NamedPair pair = {};                       ///< of that distance
  std::optional<double> at_proof_time = {};  ///< coal's distance where the proof says `collides`
};

struct SceneAnswers {
  std::size_t bodies = 0;
  double preparation = 0;  ///< of the model, µs
  std::vector<Answer> answers;
};

bool is_hit(CoalScene& scene, const Edge& edge, double clearance) {
  for (int i = 0; i <= samples; ++i) {
    if (scene.collides(edge.at(i / double(samples)), clearance)) return true;
  }
  return false;
}

/// The least distance along the edge: at the samples, and at `refine` places of each interval
/// beside the ten least ones.
void set_least(CoalScene& scene, int refine, Answer& answer) {
  answer.least = std::numeric_limits<double>::infinity();
  const auto measure = [&](double s) {
    const CoalDistance distance = scene.least_distance(answer.edge.at(s));
    if (distance.value < answer.least) {
      answer.least = distance.value;
      answer.least_at = s;
      answer.pair = distance.names;
    }
    return distance.value;
  };
  std::vector<std::pair<double, int>> found;
  for (int i = 0; i <= samples; ++i) found.emplace_back(measure(i / double(samples)), i);
  std::sort(found.begin(), found.end());
  std::vector<bool> refined(samples, false);
  for (std::size_t k = 0; k < 10; ++k) {
    for (const int interval : {found[k].second - 1, found[k].second}) {
      if (interval < 0 || interval >= samples || refined[interval]) continue;
      refined[interval] = true;
      for (int i = 1; i < refine; ++i) measure((interval + i / double(refine)) / samples);
    }
  }
}

double time_of(const auto& call) {
  const double start = cpu_microseconds();
  call();
  return cpu_microseconds() - start;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Answer answer_of(const CollisionModel& model, CoalScene& coal, const Edge& edge,
                 const Options& options) {
  Answer answer{edge, {}, 0, false, 0, 0, 0, {}, {}};
  const Trajectory motion = edge.motion(model.arm());
  std::vector<double> certified, sampling;
  for (int pass = 0; pass < options.passes; ++pass) {
    certified.push_back(time_of([&] { answer.proof = prove_clearance(model, motion); }));
    sampling.push_back(time_of([&] { answer.sampled = is_hit(coal, edge, options.clearance); }));
  }
  answer.certified = median(certified);
  answer.sampling = median(sampling);
  if (!has_coal()) return answer;
  set_least(coal, options.refine, answer);
  if (answer.proof.status == ClearanceStatus::collides) {
    answer.at_proof_time = coal.least_distance(edge.at(answer.proof.time)).value;
  }
  return answer;
}

SceneAnswers answers_in(const ShapedArm& arm, const Problem& problem, const Options& options,
                        std::mt19937_64& engine) {
  SceneAnswers scene;
  std::optional<CollisionModel> model;
  scene.preparation = time_of([&] {
    model.emplace(arm.arm, arm.links, problem.scene,
                  CollisionOptions{.clearance = options.clearance});
  });
  CoalScene coal(arm.arm, arm.links, problem.scene);
  for (const Edge& edge : edges_of(*model, problem, options.edges, engine)) {
    scene.answers.push_back(answer_of(*model, coal, edge, options));
  }
  return scene;
}

std::vector<double> row(const Configuration& q) { return {q.begin(), q.end()}; }

void write(std::ofstream& file, const Problem& problem, const SceneAnswers& scene) {
  nlohmann::json line{{"name", problem.name},
                      {"scene", nlohmann::json::parse(scene_to_json(problem.scene))}};
  for (const Answer& answer : scene.answers) {
    line["edges"].push_back({{"from", row(answer.edge.from)},
                             {"to", row(answer.edge.to)},
                             {"certified", name(answer.proof.status)},
                             {"certified_us", answer.certified},
                             {"sampled", answer.sampled},
                             {"sampled_us", answer.sampling},
                             {"least", answer.least},
                             {"least_at", answer.least_at}});
  }
  file << line.dump() << "\n";
}

/// Sums over the edges of all scenes.
struct Sums {
  std::size_t edges = 0;
  std::array<std::size_t, 3> status = {};
  std::array<std::vector<double>, 4> certified;  ///< times by status, and of all
  std::vector<double> sampling, sampling_clear;  ///< times of all edges, and of those proved clear
  std::size_t missed = 0, refuted = 0, unconfirmed = 0;
};

/// Prints each disagreement with the referee's distance.
void add(const Answer& answer, const Problem& problem, double clearance, Sums& sums) {
  ++sums.edges;
  const auto status = static_cast<std::size_t>(answer.proof.status);
  ++sums.status.at(status);
  sums.certified.at(status).push_back(answer.certified);
  sums.certified[3].push_back(answer.certified);
  sums.sampling.push_back(answer.sampling);
  if (answer.proof) sums.sampling_clear.push_back(answer.sampling);
  if (!has_coal()) return;
  constexpr double precision = 1e-6;  // of coal's distances
  const bool clear = answer.proof.status == ClearanceStatus::clear;
  const bool collides = answer.proof.status == ClearanceStatus::collides;
  const bool false_yes = clear && (answer.sampled || answer.least < clearance - precision);
  const bool unconfirmed = collides && *answer.at_proof_time > clearance + precision;
  sums.refuted += false_yes;
  sums.unconfirmed += unconfirmed;
  sums.missed += collides && !answer.sampled;
  if (!false_yes && !unconfirmed) return;
  std::printf("  %s: %s, coal's samples %s; least of coal's distances %.9f m at %.6f (%s, %s)",
              problem.name.c_str(), name(answer.proof.status).c_str(),
              answer.sampled ? "collide" : "free", answer.least, answer.least_at,
              answer.pair[0].c_str(), answer.pair[1].c_str());
  if (collides) std::printf("; coal at the proof's time %.9f m", *answer.at_proof_time);
  std::printf("\n");
}

void print_times(const char* what, const std::vector<double>& times) {
  if (times.empty()) return;
  std::vector<double> sorted = times;
  std::sort(sorted.begin(), sorted.end());
  const double mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / double(sorted.size());
  std::printf("| %s | %zu | %.1f | %.1f | %.1f | %.1f | %.0f |\n", what, sorted.size(), mean,
              sorted[sorted.size() / 2], sorted[sorted.size() * 95 / 100], sorted.back(),
              1e6 / mean);
}

/// Returns whether coal refutes no answer.
bool run(const Options& options) {
  std::mt19937_64 engine(options.seed);
  const ShapedArm arm = read_shaped_arm(options.arm);
  std::vector<Problem> problems = options.problems.empty()
                                      ? random_problems(options.scenes, options.boxes, engine)
                                      : read_problems(options.problems, arm);
  if (problems.size() > options.scenes) problems.resize(options.scenes);
  std::ofstream file;
  if (!options.out.empty()) file.open(options.out);
  Sums sums;
  std::vector<double> preparation;
  for (const Problem& problem : problems) {
    const SceneAnswers scene = answers_in(arm, problem, options, engine);
    preparation.push_back(scene.preparation);
    for (const Answer& answer : scene.answers) add(answer, problem, options.clearance, sums);
    if (file.is_open()) write(file, problem, scene);
  }
  std::printf(
      "%s in %zu scenes, %zu edges, clearance %g mm, seed %u; preparing a model takes %.2f "
      "ms (median)\n\n",
      arm.arm.name().c_str(), problems.size(), sums.edges, 1e3 * options.clearance, options.seed,
      1e-3 * median(preparation));
  std::printf(
      "| answer | edges | mean µs | median | 95 %% | worst | edges a second |\n"
      "|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < 3; ++i) {
    print_times(name(static_cast<ClearanceStatus>(i)).c_str(), sums.certified[i]);
  }
  print_times("all, certified", sums.certified[3]);
  if (!has_coal()) {
    std::printf("\nLeft out: coal, whose wheel is not installed.\n");
    return true;
  }
  print_times("clear, coal's samples every 0.05 rad", sums.sampling_clear);
  print_times("all, coal's samples", sums.sampling);
  std::printf(
      "\nProved clear, but coal finds less than the clearance: %zu. Collides, but coal's "
      "distance there is above the clearance: %zu. Collides, and missed by coal's samples: "
      "%zu.\n",
      sums.refuted, sums.unconfirmed, sums.missed);
  return sums.refuted + sums.unconfirmed == 0;
}

}  // namespace
}  // namespace beeline::bench

int main(int argc, char** argv) {
  using namespace beeline::bench;
  Options options;
  CLI::App app("Certified edges of 1 rad beside coal's samples");
  app.add_option("arm", options.arm, "URDF file of the arm")->required();
  app.add_option("--problems", options.problems,
                 "Folder with problems of MotionBenchMaker; default: random boxes");
  app.add_option("--edges", options.edges,
                 "Edges from random configurations of a scene, and from its goal");
  app.add_option("--scenes", options.scenes, "Most scenes");
  app.add_option("--boxes", options.boxes, "Boxes of a random scene");
  app.add_option("--refine", options.refine, "Division of an interval between two samples");
  app.add_option("--passes", options.passes, "Times that an edge is timed");
  app.add_option("--clearance", options.clearance, "m");
  app.add_option("--seed", options.seed);
  app.add_option("--out", options.out, "File of JSON lines");
  CLI11_PARSE(app, argc, argv);
  try {
    stay_on_one_core();
    return run(options) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
