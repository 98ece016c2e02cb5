// Binds a key of an ADF file to the member of a description that it fills: the member's type is how its value is read,
// and its value in a description that nobody has changed is the default. Constant data, any thread.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "math/types.h"

namespace ambf::scene {

// A member that is an enumeration.
struct EnumMember {
  void* value = nullptr;
  int (*get)(const void* value) = nullptr;
  void (*set)(void* value, int number) = nullptr;
};

// A member that is a description of its own, filled by the keys of a map.
struct InnerMember {
  void* object = nullptr;
  const void* type = nullptr;  // type_of<T>()
};

using Member = std::variant<std::monostate, bool*, int*, unsigned*, double*, std::string*, math::Vec3*, math::Pose*,
                            std::optional<double>*, std::optional<math::Vec3>*, std::optional<math::Pose>*,
                            std::vector<std::string>*, EnumMember, InnerMember>;

namespace detail {

template <class T>
inline constexpr char kTypeMark = 0;

template <class T, class Variant>
struct IsAlternative;
template <class T, class... Alternatives>
struct IsAlternative<T, std::variant<Alternatives...>> : std::disjunction<std::is_same<T, Alternatives>...> {};

template <class T>
struct OwnerOf;
template <class Value, class Owner>
struct OwnerOf<Value Owner::*> {
  using type = Owner;
};

template <auto First, auto... Rest, class Object>
auto& follow(Object& object) {
  if constexpr (sizeof...(Rest) == 0) {
    return object.*First;
  } else {
    return follow<Rest...>(object.*First);
  }
}

}  // namespace detail

// The same address for each use of one type.
template <class T>
constexpr const void* type_of() {
  return &detail::kTypeMark<T>;
}

template <class Value>
Member member_of(Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return EnumMember{&value, [](const void* v) { return static_cast<int>(*static_cast<const Value*>(v)); },
                      [](void* v, int number) { *static_cast<Value*>(v) = static_cast<Value>(number); }};
  } else if constexpr (detail::IsAlternative<Value*, Member>::value) {
    return &value;
  } else {
    return InnerMember{&value, type_of<Value>()};
  }
}

struct Binding {
  Member (*find)(void* owner) = nullptr;  // the member in a description of type `owner`
  const void* (*unchanged)() = nullptr;   // a description with all its defaults
  const void* owner = nullptr;            // type_of<Owner>()
  constexpr explicit operator bool() const { return find != nullptr; }
};

// to<&Light::parent>(), to<&Light::beam, &state::Beam::spot_exponent>()
template <auto First, auto... Rest>
constexpr Binding to() {
  using Owner = typename detail::OwnerOf<decltype(First)>::type;
  return {[](void* owner) { return member_of(detail::follow<First, Rest...>(*static_cast<Owner*>(owner))); },
          []() -> const void* {
            static const Owner unchanged{};
            return &unchanged;
          },
          type_of<Owner>()};
}

}  // namespace ambf::scene
