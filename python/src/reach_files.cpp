#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>

#include "bindings.h"
#include "reach_arrays.h"

namespace beeline::python {
namespace {

#ifdef BEELINE_HDF5
ReachMap read_map(const std::string& path) { return ReachMap(path); }
Ending write_map(const Arm& arm, const ReachGrid& grid, const std::string& path,
                 const ReachMapOptions& options) {
  return compute_reach_map(arm, grid, path, options);
}
void join_maps(const std::vector<std::string>& parts, const std::string& path, bool incomplete) {
  merge_reach_maps(parts, path, incomplete);
}
#else
[[noreturn]] void refuse() {
  throw Error(
      "this module is built without HDF5, which files of reach maps need; h5py reads them, and "
      "`pip install . -C cmake.define.BEELINE_HDF5=ON` builds the module with it");
}
ReachMap read_map(const std::string&) { refuse(); }
Ending write_map(const Arm&, const ReachGrid&, const std::string&, const ReachMapOptions&) {
  refuse();
}
void join_maps(const std::vector<std::string>&, const std::string&, bool) { refuse(); }
#endif

constexpr const char* without_hdf5 = "and in a build without HDF5";

void bind_merging(nb::module_& m) {
  Signature merge(
      "merge_reach_maps", "None",
      std::string("Joins files that hold parts of one map into one file. Raises Error for parts of "
                  "different maps, where parts are missing unless `incomplete`, ") +
          without_hdf5 + ".");
  merge.takes("parts", "collections.abc.Sequence[str | os.PathLike[str]]", "The files.")
      .takes("path", path_like, "The file that is written.")
      .takes("incomplete", "bool", "Parts may be missing.", "False");
  define(
      m,
      [](nb::handle parts, nb::handle path, nb::handle incomplete) {
        if (!is_list(parts)) {
          raise_type("parts", "a list of paths", parts);
        }
        std::vector<std::string> files;
        for (nb::handle part : nb::borrow(parts)) files.push_back(path_from(part, "parts"));
        const std::string file = path_from(path, "path");
        const bool some = Value<bool>::from(incomplete, "incomplete");
        const LockRelease release;
        join_maps(files, file, some);
      },
      merge, nb::arg("parts"), nb::arg("path"), nb::arg("incomplete") = false);
}

}  // namespace

ReachMap loaded_map(const std::string& path) {
  const LockRelease release;
  return read_map(path);
}

void bind_map_files(nb::module_& m, nb::class_<ReachMap>& map) {
  Signature load("load", "ReachMap",
                 std::string("Opens a file of a map. Raises Error for one that is no reach map, ") +
                     without_hdf5 + ".");
  load.takes("path", path_like, "An HDF5 file.");
  define_static(
      map, [](nb::handle path) { return loaded_map(path_from(path, "path")); }, load,
      nb::arg("path"));

  Signature compute(
      "compute_reach_map", Value<Ending>::type(),
      std::string("Computes a map, or a part of it, into an HDF5 file. The folder `path`.parts "
                  "holds what is computed, which a call continues that follows one that was ended "
                  "or killed; its slabs are deleted in the end. The memory needed does not depend "
                  "on the size of the map. Raises Error as reach_cells() does, for a shard that "
                  "does not exist, for a folder with parts of another map, ") +
          without_hdf5 + ".");
  compute.takes_arm()
      .takes("grid", "ReachGrid", "The cells.")
      .takes("path", path_like, "The file; it is replaced.")
      .options<ReachOptions>()
      .options<ShardOptions>();
  compute.returns("`complete`, or which limit of the budget ended it.");
  define(
      m,
      [](const Arm& arm, const GridOfArm& grid, nb::handle path, const nb::kwargs& keywords) {
        auto [reach, shard] = reach_options<ShardOptions>(arm, keywords);
        const std::string file = path_from(path, "path");
        ReachMapOptions asked{reach, shard.shard};
        return Value<Ending>::to(
            unlocked(asked.reach.budget, [&] { return write_map(arm, grid.grid, file, asked); }));
      },
      compute, nb::arg("arm"), nb::arg("grid"), nb::arg("path"), nb::arg("options"));
  bind_merging(m);
}

}  // namespace beeline::python
