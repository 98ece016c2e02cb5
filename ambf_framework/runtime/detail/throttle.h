// Lets a client drive the simulation step by step (dissertation §3.7.2, Fig. 3.18): while throttling is enabled, each
// toggle of the client's step clock grants n_skip_steps steps of dt_fixed. No toggle is lost: those that come while the
// simulation is busy wait, each with its own number of steps. Pure; fixed storage. Owned by the physics thread.
//
// A toggle is a change of step_clock against the message before *of the same client*; every client's clock starts low,
// as those of the clients in use do. So a client that replaces a dead one is never out of step with it, whatever level
// that one left. A silent client keeps the simulation waiting, unless release_when_silent is set.
#pragma once

#include <array>
#include <cstdint>

#include "state/command.h"

namespace ambf::runtime {

class Throttle {
 public:
  static constexpr unsigned kDefaultSkipSteps = 10;  // before the first message

  explicit Throttle(bool release_when_silent = false) : release_when_silent_(release_when_silent) {}

  // Messages in the order in which they came.
  void on_command(const state::WorldCommand& command);
  // The Step service drives: the world waits from now on, as if a message had enabled throttling.
  void engage() { engaged_ = true; }
  // The watchdog of the world command has expired.
  void on_silence();

  bool engaged() const { return engaged_; }

  // The toggle in work: how many of its steps are left (a toggle of 0 steps is finished by steps_done(0)).
  bool toggle_waiting() const { return in_work_ || grant_count_ > 0; }
  unsigned steps_left() const;
  // `steps` (at most steps_left) were run; returns true when that finished a toggle: its frame is to be published.
  bool steps_done(unsigned steps);

  std::uint64_t toggles_received() const { return received_; }
  std::uint64_t toggles_finished() const { return finished_; }

 private:
  // Toggles that wait; equal ones in a row share an entry. When there is no entry left, the last one takes in what
  // differs: the sums of toggles and steps stay right, only their distribution is evened out.
  struct Grant {
    std::uint64_t toggles = 0, steps = 0;
  };
  struct Client {
    std::uint64_t id = 0;
    std::uint64_t last_seen = 0;  // 0: entry is free
    bool clock = false;
  };
  static constexpr std::size_t kGrants = 256;
  static constexpr std::size_t kClients = 16;

  Client& client(std::uint64_t id);
  void add_toggle(unsigned steps);
  std::uint64_t steps_of_next() const;
  void release();

  std::array<Grant, kGrants> grants_{};
  std::size_t first_grant_ = 0, grant_count_ = 0;
  std::array<Client, kClients> clients_{};
  std::uint64_t messages_ = 0;

  bool release_when_silent_;
  bool engaged_ = false;
  unsigned skip_steps_ = kDefaultSkipSteps;
  bool in_work_ = false;  // a toggle was begun
  std::uint64_t left_ = 0;
  std::uint64_t received_ = 0, finished_ = 0;
};

}  // namespace ambf::runtime
