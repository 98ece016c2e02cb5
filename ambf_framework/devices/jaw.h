// What a hand asks of its tool's jaw: 0 closed .. 1 open. The jaw follows the hand only once the hand's opening has met
// the tool's, so that a grasp survives the start, a clutch and a return. Device's thread.
#pragma once

namespace ambf::devices {

struct JawInput {
  bool has_gripper = false;  // the device senses its opening
  double gripper = 0.0;      // 0 .. 1
  bool has_button = false;   // a button g1 is mapped: pressed is closed
  bool button = false;
  double offset = 0.0;   // without gripper and button: 0.5 and this, which the mode "jaw" changes
  bool engaged = false;  // while clutched the jaw stays as it is
  double tool = 0.5;     // how far the tool's jaw is open now
};

class Jaw {
 public:
  static constexpr double kMeets = 0.03;  // of the whole opening

  void restart() { *this = Jaw(); }  // another tool
  void step(const JawInput& in);

  double hand() const { return hand_; }  // the hand's opening
  double tool() const { return tool_; }  // what is asked of the tool; means something once moves()
  bool moves() const { return ever_; }   // it has followed once: what it held then stays in force
  bool follows() const { return follows_; }

 private:
  double hand_ = 0.5, tool_ = 0.5;
  bool known_ = false;  // hand_ is that of a step before
  bool ever_ = false, follows_ = false;
};

}  // namespace ambf::devices
