// Whether the commands of a kind name other objects (endpoints/object_endpoint.h). Private to ros_comm. C++17.
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "state/command.h"
#include "state/structure.h"

namespace ambf::ros_comm {

template <class Messages, class = void>
inline constexpr bool kNamesObjects = false;

template <class Messages>
inline constexpr bool
    kNamesObjects<Messages, std::void_t<decltype(Messages::read(std::declval<const typename Messages::Command&>(),
                                                                std::declval<const state::Structure&>(),
                                                                std::uint32_t{}, std::declval<state::Command&>()))>> =
        true;

}  // namespace ambf::ros_comm
