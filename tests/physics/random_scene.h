// Ten random bodies at a time: joints of all kinds, contacts, motors, spins up to 500 rad/s, mass ratios up to 1000.
// Used by tests and by a benchmark, which ask that they stay numbers and gain no energy.
#pragma once

#include <memory>
#include <vector>

#include "tests/physics/fixtures.h"

namespace ambf::physics::testing {

class RandomScene {
 public:
  explicit RandomScene(unsigned seed, double h = 0.001);
  ~RandomScene();

  struct Result {
    bool finite = true;
    double gain = 0.0;  // largest energy above what bodies had and motors gave, as a share of both
    double gap = 0.0;   // m, the largest of a joint
  };
  Result run(double seconds);

 private:
  double energy() const;  // J

  double h_;
  World world_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<std::unique_ptr<Joint>> joints_;
  double datum_ = 0.0;  // m: potential energies are measured from here, so that none is negative
};

}  // namespace ambf::physics::testing
