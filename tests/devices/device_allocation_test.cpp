// A device's cycle neither allocates, frees nor locks: counted, not believed.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <cstdlib>
#include <new>

#include "devices/driver.h"
#include "tests/devices/cycle_rig.h"

namespace {
thread_local long allocations = 0;  // and frees
thread_local long locks = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  if (p != nullptr) ++allocations;
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept { operator delete(p); }

extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  ++locks;
  return real(mutex);
}

namespace ambf::devices::testing {
namespace {

TEST(DeviceAllocation, ACycleDoesNothingThatWaits) {
  CycleRig rig;
  rig.start();
  rig.run_until_engaged();
  rig.run(1.0);  // percentiles and rates were counted once
  ASSERT_GT(allocations, 0) << "the counter itself works";
  const long allocated = allocations, locked = locks;
  for (int i = 0; i < 1000; ++i) {
    rig.driver.next.T_u_tip.position += math::Vec3{1e-5, 0.0, 0.0};
    if (i % 100 == 50) rig.press(0, i % 200 == 50);
    if (i == 600) rig.driver.reading = Reading::nothing_new;  // a fault, and its end
    if (i == 700) rig.driver.reading = Reading::sample;
    rig.step();
  }
  EXPECT_EQ(allocations - allocated, 0);
  EXPECT_EQ(locks - locked, 0);
}

TEST(DeviceAllocation, NorDoesReadingAScriptedDevice) {
  DriverRequest request;
  request.type = "scripted";
  request.options = {{"motion", "ellipse"}, {"noise", "0.001"}, {"delay", "0.001"}};
  const auto driver = find_driver(request)->make(request);
  ASSERT_EQ(driver->open(), "");
  const long allocated = allocations, locked = locks;
  Sample sample;
  for (int i = 0; i < 1000; ++i) driver->read(sample, 0.0);
  EXPECT_EQ(allocations - allocated, 0);
  EXPECT_EQ(locks - locked, 0);
}

}  // namespace
}  // namespace ambf::devices::testing
