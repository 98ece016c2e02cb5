// The folder's parts are templates; this file makes sure that each of its headers stands alone and instantiates
// completely.
#include "exchange/bounded_queue.h"
#include "exchange/dirty_set.h"
#include "exchange/frame_pool.h"
#include "exchange/latest_slot.h"
#include "exchange/signal.h"

namespace ambf::exchange {

template class BoundedQueue<int>;
template class FramePool<int>;
template class LatestSlot<int>;

}  // namespace ambf::exchange
