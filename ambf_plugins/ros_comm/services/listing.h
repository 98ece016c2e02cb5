// What is loaded, as the services List, Load, Unload and Remove answer it. Pure functions of a structure. Private to
// ros_comm. C++17.
#pragma once

#include <ambf_msgs/List.h>

#include <set>
#include <string>
#include <vector>

#include "ros_comm/endpoints/topic_names.h"
#include "state/structure.h"

namespace ambf::ros_comm {

// Models, objects and joints, of one model or of all (empty name).
void fill_list(const state::Structure& structure, const TopicNames& topics, const std::string& model,
               ambf_msgs::List::Response& response);

// Appends the full names of a model's objects and joints, in load order.
void append_names(const state::Structure& structure, state::ModelId model, std::vector<std::string>& objects,
                  std::vector<std::string>& joints);

// Null when there is no model of this name.
const state::ModelInfo* find_model(const state::Structure& structure, const std::string& name);

// Full names of all objects and joints, of one model or of all (empty name).
std::set<std::string> names_in(const state::Structure& structure, const std::string& model = {});

}  // namespace ambf::ros_comm
