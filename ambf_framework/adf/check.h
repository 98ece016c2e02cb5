// Everything that can be said of a file without simulating it: what its reader says, what is nowhere in the file
// (bodies of joints, parents of cameras and lights), and what loading it would say. `ambf_simulator --check` prints it.
// Reads files; any thread; never throws.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adf/adf.h"
#include "adf/kind.h"

namespace ambf::adf {

// What loading a model says beyond its reader: meshes, materials, gains, parents. Above this folder: who checks brings
// it along.
using DryLoad = std::function<base::Diagnostics(const scene::Model& model)>;

// A launch file is followed to its world, colours and devices; its models are only looked for, because each is loaded
// when asked for. `models`: read before; a description of CRTK arms is held against those that have its bodies.
base::Diagnostics check_file(const std::string& path, const DryLoad& dry_load = {},
                             const std::vector<scene::Model>& models = {});

// Tells of joints whose bodies this file does not hold, and of cameras and lights without their parents: they must come
// from another file. Such joints leave the model, such cameras and lights hang in the world, so that loading says no
// more of them.
base::Diagnostics take_out_orphans(scene::Model& model);

}  // namespace ambf::adf
