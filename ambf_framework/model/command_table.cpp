#include "model/command_table.h"

#include <chrono>

#include "model/command_slots.h"

namespace ambf::model {
namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

class Port : public state::CommandPort {
 public:
  Port(std::shared_ptr<CommandSlots> slots, CommandSlot& slot, CommandTable& table)
      : slots_(std::move(slots)), slot_(slot), table_(table) {}

  void post(const state::Command& command) override {
    // A command for another kind of object is the caller's mistake; it must not reach the object.
    const bool for_body = std::holds_alternative<state::RigidBodyCommand>(command);
    if (for_body != (slots_->kind() == state::ObjectKind::rigid_body)) return;
    slot_.latest.post(command, now_ns());
    table_.mark(slots_->object().index);
  }
  void keep_alive() override {
    slot_.latest.keep_alive(now_ns());
    table_.mark(slots_->object().index);
  }
  void release() override {
    slot_.latest.release();
    table_.mark(slots_->object().index);
  }

 private:
  std::shared_ptr<CommandSlots> slots_;
  CommandSlot& slot_;
  CommandTable& table_;
};

}  // namespace

CommandTable::CommandTable(double watchdog_s) : watchdog_s_(watchdog_s) {}

CommandTable::~CommandTable() = default;

std::unique_ptr<state::CommandPort> CommandTable::bind(state::ObjectId object, state::Source source) {
  const int number = static_cast<int>(source);
  if (number < 0 || number >= state::kMaxSources) return nullptr;
  std::shared_ptr<CommandSlots> slots;
  {
    const std::lock_guard lock(mutex_);
    if (object.index >= by_index_.size()) return nullptr;
    slots = by_index_[object.index];
  }
  if (slots == nullptr || slots->object() != object) return nullptr;
  CommandSlot& slot = slots->find_or_make(number);
  return std::make_unique<Port>(std::move(slots), slot, *this);
}

std::shared_ptr<CommandSlots> CommandTable::add(state::ObjectId object, state::ObjectKind kind) {
  auto slots = std::make_shared<CommandSlots>(object, kind);
  const std::lock_guard lock(mutex_);
  if (by_index_.size() <= object.index) by_index_.resize(object.index + 1);
  by_index_[object.index] = slots;
  return slots;
}

void CommandTable::remove(state::ObjectId object) {
  const std::lock_guard lock(mutex_);
  if (object.index < by_index_.size()) by_index_[object.index].reset();
}

}  // namespace ambf::model
