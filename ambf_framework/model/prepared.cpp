#include "model/prepared.h"

#include "model/detail/swap.h"

namespace ambf::model {

Prepared::Prepared() = default;
Prepared::Prepared(Prepared&&) noexcept = default;
Prepared& Prepared::operator=(Prepared&&) noexcept = default;
Prepared::~Prepared() = default;

Garbage::Garbage() = default;
Garbage::Garbage(Garbage&&) noexcept = default;
Garbage& Garbage::operator=(Garbage&&) noexcept = default;
Garbage::~Garbage() = default;

}  // namespace ambf::model
