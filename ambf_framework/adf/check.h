// Everything that can be said of a file without simulating it: what loading says, and what would go wrong afterwards (joints whose bodies
// are nowhere in the file, gains that cannot be stable). `ambf_simulator --check` prints it. Reads files; any thread; never throws.
#pragma once

#include <functional>
#include <string>

#include "adf/adf.h"

namespace ambf::adf {

enum class FileKind { model, world, launch, colors, input_devices };

// What kind of file a text is, by its top-level keys; a file that fits nothing else is a model.
FileKind kind_of(const std::string& text);

// What is wrong with the contents of a mesh file, "" when nothing is. Meshes are read by other folders: who checks brings it along.
using MeshProbe = std::function<std::string(const std::string& path)>;

// A launch file is followed to its world, colours and devices; its models are only looked for, because each is loaded when asked for.
base::Diagnostics check_file(const std::string& path, const MeshProbe& mesh_probe = {});

// Warnings about controllers whose damping turns velocities round within one step of 1 ms (D * dt > inertia). Says nothing where the
// inertia depends on meshes or on further bodies behind a joint.
base::Diagnostics check_gains(const scene::Model& model);
// Joints, cameras and lights whose bodies this file does not hold: they must come from another file.
base::Diagnostics check_parents(const scene::Model& model);

// Looking for the bodies of this many joints would take longer than a check may.
bool too_many_pairs(const scene::Model& model);

}  // namespace ambf::adf
