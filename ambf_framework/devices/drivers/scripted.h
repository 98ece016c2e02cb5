// A device that a file describes: it moves by itself, for demonstrations, tests and benchmarks. Type "scripted".
//
// Options of `driver`:
//   motion: none, circle, ellipse, line, path  what the tip does about its start, in U; `none`: it stands still
//   path                                       points "s x y z roll pitch yaw jaw; ..." (s, m, rad, 0 .. 1)
//   repeat (s)                                 the path begins again after so long; 0: it ends at its last point
//   size (m), rate (rad/s)                     amplitude, and how fast the motion goes round
//   axis: x, y, z                              of a line; a circle lies across it
//   turn (rad), jaw: 0 .. 1                    amplitude of a rotation about `axis`; the jaw; jaw swing: amplitude
//   hertz (Hz)                                 of its samples; 0: as often as it is read
//   noise (m), delay (s)                       of each sample; the delay varies at random between 0 and this
//   dropout every (s), dropout (s)             falls silent so often, for so long
//   hold (s), force (N)                        hold at the start; it can exert forces of that size
//   seed                                       of noise and delays
#pragma once

#include "devices/driver.h"

namespace ambf::devices {

DriverKind scripted_kind();

}  // namespace ambf::devices
