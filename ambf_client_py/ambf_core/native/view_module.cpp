// The Python module _ambf_view: what cameras see of a world of _ambf_core, and its window. ambf_core loads it when one
// of them is asked for, since it brings OpenGL.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "frame_capsule.h"
#include "render/camera/intrinsics.h"
#include "render/pictures/offscreen.h"
#include "window.h"

namespace nb = nanobind;

namespace ambf::python {
namespace {

template <class T>
using Array = nb::ndarray<T, nb::device::cpu, nb::c_contig>;

// Optical axes are x right, y down, z ahead; the camera's are x backwards, y right, z up.
math::Pose optical(const math::Pose& T_world_camera) {
  return {T_world_camera.position, T_world_camera.orientation * math::Quat{-0.5, -0.5, 0.5, 0.5}};
}

// A context of OpenGL for one world. It is of the thread that made it, and of no forked process.
class Pictures {
 public:
  explicit Pictures(const std::string& backend) {
    const auto wanted = render::offscreen_backend(backend);
    if (!wanted) throw nb::value_error(("renderer '" + backend + "': 'auto', 'osmesa' or 'egl'").c_str());
    std::string why;
    const nb::gil_scoped_release release;
    offscreen_ = render::Offscreen::open(why, *wanted);
    if (offscreen_ == nullptr) throw std::runtime_error("no pictures can be drawn: " + why);
  }
  ~Pictures() {
    if (!is_ours()) (void)offscreen_.release();  // OpenGL would touch what another thread or process has
  }
  Pictures(const Pictures&) = delete;
  Pictures& operator=(const Pictures&) = delete;

  std::string renderer() const { return offscreen_->renderer(); }

  // Arrays of height x width, or of no size where they are not wanted. `view`: eye, what it looks at, field of view,
  // near and far plane, instead of the camera in `slot`. Returns fx, fy, cx, cy, skew; the pose of the optical frame;
  // what users should know.
  std::tuple<std::array<double, 5>, std::array<double, 7>, std::vector<std::string>> draw(
      const nb::capsule& capsule, std::size_t slot, const std::vector<double>& view, int width, int height,
      const Array<std::uint8_t>& rgb, const Array<float>& depth_m, const Array<std::int32_t>& bodies) {
    if (!is_ours()) throw std::runtime_error("pictures of a world are drawn by the thread that drew its first one");
    const state::Frame& frame = frame_in(capsule);
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const auto fits = [](std::size_t size, std::size_t wanted) { return size == 0 || size == wanted; };
    if (!fits(rgb.size(), 3 * pixels) || !fits(depth_m.size(), pixels) || !fits(bodies.size(), pixels)) {
      throw std::invalid_argument("an array does not fit the picture");
    }
    base::Diagnostics findings;
    std::vector<render::Shot> shots(1);
    render::Shot& shot = shots.front();
    {
      const nb::gil_scoped_release release;
      set_camera(frame, slot, view, shot);
      shot.width = width;
      shot.height = height;
      shot.color = rgb.size() > 0;
      shot.measured = depth_m.size() > 0 || bodies.size() > 0;
      offscreen_->shoot(frame, shots, findings, render::stream_quality(offscreen_->in_software()));
      if (!shot.failure.empty()) throw std::runtime_error("the picture could not be drawn: " + shot.failure);
      if (rgb.size() > 0) std::ranges::copy(shot.rgb, rgb.data());
      if (depth_m.size() > 0) {
        std::ranges::transform(shot.depth_m, depth_m.data(),
                               [](float z) { return z > 0.0F ? z : std::numeric_limits<float>::quiet_NaN(); });
      }
      if (bodies.size() > 0) {
        std::ranges::transform(shot.bodies, bodies.data(), [](std::uint32_t row) {
          return row == state::kNone ? -1 : static_cast<std::int32_t>(row);
        });
      }
    }
    const state::Intrinsics in = render::intrinsics_of(shot.camera, width, height);
    const auto [p, q] = optical(shot.camera.T_world_camera);
    std::vector<std::string> texts;
    for (const base::Diagnostic& finding : findings) texts.push_back(base::to_string(finding));
    return {{in.fx, in.fy, in.cx, in.cy, in.skew}, {p.x, p.y, p.z, q.x, q.y, q.z, q.w}, texts};
  }

 private:
  bool is_ours() const { return thread_ == std::this_thread::get_id() && process_ == getpid(); }

  static void set_camera(const state::Frame& frame, std::size_t slot, const std::vector<double>& view,
                         render::Shot& shot) {
    if (view.empty()) {
      shot.camera = render::Offscreen::camera_of(frame, slot);
      const state::CameraInfo& info = frame.structure->cameras.at(slot);
      shot.multipass = info.multipass;
      shot.shaders = info.preprocessing_shaders;
      shot.depth_shaders = info.depth_shaders;
      return;
    }
    if (view.size() != 9) throw std::invalid_argument("a view has nine numbers");
    shot.camera.T_world_camera = render::looking_at({view[0], view[1], view[2]}, {view[3], view[4], view[5]});
    shot.camera.field_of_view_rad = view[6];
    shot.camera.near_m = view[7];
    shot.camera.far_m = view[8];
  }

  std::unique_ptr<render::Offscreen> offscreen_;
  const std::thread::id thread_ = std::this_thread::get_id();
  const pid_t process_ = getpid();
};

void bind_pictures(nb::module_& m) {
  nb::class_<Pictures>(m, "Pictures")
      .def(nb::init<const std::string&>())
      .def_prop_ro("renderer", &Pictures::renderer)
      .def("draw", &Pictures::draw);
}

}  // namespace
}  // namespace ambf::python

NB_MODULE(_ambf_view, m) {
  ambf::python::bind_pictures(m);
  ambf::python::bind_window(m);
}
