// Contacts of one island, solved by sequential impulse: for each point a normal row (x >= 0) and a pair of friction
// rows bounded by the circle |f| <= mu x; rolling and spinning friction rows follow. One sweep visits all normals,
// then all friction, as Bullet does, on rows packed for the cache. It never finds contacts and knows no Bullet.
// Storage only grows. Physics thread.
#pragma once

#include <vector>

#include "physics/joints/body_delta.h"

namespace ambf::physics {

// J = {n, ra x n, -n, rb'} with rb' = -(rb x n); the response of the angular parts is stored, that of the linear
// parts is n / m of the body.
struct ContactRow {
  double axis[3];        // n; zero for rolling and spinning friction
  double angular_a[3];   // ra x n
  double response_a[3];  // Ia^-1 (ra x n)
  double target;         // wanted J dv with bias, times inverse_diagonal (N s)
  double inverse_diagonal;
  double softness;  // relative, as Bullet's rows have it
  double impulse;
  double angular_b[3];
  double response_b[3];
};

struct NormalRow : ContactRow {
  int body_a;  // index into the velocities; -1: does not move
  int body_b;
  double push;          // what a push out of depth of its own wants (N s), >= 0; not in the target
  double push_impulse;  // what it got
  double evening;       // share by which its impulse gives way towards `mean`; see even_out()
  double mean;          // of the face it belongs to, at the step's start (N s)
  double passed;        // what it gave in bounces that were passed on (N s), beside `impulse`
};

struct FrictionRows {
  ContactRow direction[2];
  int body_a;
  int body_b;
  int normal;  // index of the normal row that presses
  int count;   // directions in use: 1 or 2
  double coefficient;
  double coupling;  // how an impulse along the first direction changes the second row, in the second's impulses
};

struct RollingRow : ContactRow {
  int body_a;
  int body_b;
  int normal;
  double coefficient;  // also the largest impulse, as Bullet's rows have it
};

class ContactSystem {
 public:
  void clear();
  bool empty() const { return normals_.empty(); }

  std::vector<NormalRow>& normals() { return normals_; }
  std::vector<FrictionRows>& frictions() { return frictions_; }
  std::vector<RollingRow>& rollings() { return rollings_; }

  // How the points of a face share its load where statics leaves that open, sweeps leave as the order of the rows made
  // it, and friction then turns what slides. From here on, normals between the same two bodies in the same direction
  // give way towards their mean by their `evening`. Not single ones, and not those against what cannot move.
  void even_out();
  // One sweep; returns the largest velocity error met, squared ((m/s)^2 or (rad/s)^2).
  double sweep(BodyDelta* bodies, bool backwards);
  // Whether friction was at its bound somewhere in the last sweep.
  bool slipped() const { return slipped_; }
  // The same for the pushes: normals alone, on velocities that only move the bodies out of each other.
  double sweep_pushes(BodyDelta* moves, bool backwards);
  // Relative velocity that the changes of this step's velocities make (m/s), > 0: apart.
  static double velocity(const NormalRow& row, const BodyDelta* bodies);
  // What a normal's velocity lacks of its target, and what the moves give its push: in units of both (N s).
  static double shortfall(const NormalRow& row, const BodyDelta* bodies);
  static double pushed(const NormalRow& row, const BodyDelta* moves);

  // Fills in the coupling of a pair whose rows are complete.
  static void couple(FrictionRows& rows, const BodyDelta* bodies);
  // Adds a row's impulse to the bodies without looking at bounds (warm start).
  static void apply(const ContactRow& row, double impulse, int body_a, int body_b, BodyDelta* bodies);

 private:
  std::vector<NormalRow> normals_;
  std::vector<FrictionRows> frictions_;
  std::vector<RollingRow> rollings_;
  bool slipped_ = false;
};

}  // namespace ambf::physics
