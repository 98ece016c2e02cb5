// Gives every object its own comm instance: opens and closes endpoints as objects come and go, and publishes frames.
// Threads: one publisher (wakes on each frame), a few advertising threads that nobody waits for. Never sees model or
// physics. C++17.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "comm/middleware.h"
#include "comm/publish_rate.h"
#include "state/abilities/observe.h"

namespace ambf::comm {

struct ServerOptions {
  RateOverride rates;
  int advertising_threads = 3;                     // more hardly register faster: they wait for the master
  std::function<void()> publisher_thread_started;  // e.g. to set its priority
};

class Server {
 public:
  Server(state::ObserveAbility& observe, Middleware& middleware, ServerOptions options);
  ~Server();  // closes every endpoint, then returns
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Endpoints open now (objects and the world). For tests and the status line.
  std::size_t open_endpoints() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::comm
