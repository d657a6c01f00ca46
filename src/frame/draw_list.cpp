#include "frame/draw_list.h"

#include <algorithm>

#include "frame/grow_buffer.h"

namespace shoal::frame {
namespace {

constexpr std::size_t kViewsPerRing = 8;  // views whose commands fit before the ring starts over

}  // namespace

int BatchTable::index(const BatchKey& key) {
    const auto [found, isNew] = index_.emplace(key, int(keys_.size()));
    if (isNew) keys_.push_back(key);
    return found->second;
}

void CommandList::build(gl::Device& device, std::span<const Draw> draws, Order order) {
    commands_.clear();
    runs_.clear();
    triangles_ = 0;
    if (items_.empty()) return;

    // Ties are broken by the draw's index, so that the order never depends on how the list was filled.
    if (order == Order::backToFront) {
        std::sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
            return a.distance != b.distance ? a.distance > b.distance : a.draw < b.draw;
        });
    } else {
        int batchCount = 0;
        for (const Item& i : items_) batchCount = std::max(batchCount, i.batch + 1);
        nearest_.assign(std::size_t(batchCount), 1e30f);
        for (const Item& i : items_)
            nearest_[std::size_t(i.batch)] = std::min(nearest_[std::size_t(i.batch)], i.distance);
        std::sort(items_.begin(), items_.end(), [this](const Item& a, const Item& b) {
            if (a.batch != b.batch) {
                const float na = nearest_[std::size_t(a.batch)], nb = nearest_[std::size_t(b.batch)];
                return na != nb ? na < nb : a.batch < b.batch;
            }
            return a.distance != b.distance ? a.distance < b.distance : a.draw < b.draw;
        });
    }

    for (const Item& item : items_) {
        const Draw& d = draws[item.draw];
        if (runs_.empty() || runs_.back().batch != item.batch)
            runs_.push_back({item.batch, std::uint32_t(commands_.size()), 0});
        ++runs_.back().count;
        const std::uint32_t count = item.coarse ? d.coarseCount : d.indexCount;
        commands_.push_back(
            {count, 1, item.coarse ? d.firstCoarse : d.firstIndex, std::int32_t(d.baseVertex), item.draw});
        triangles_ += count / 3;
    }

    // Room for every draw in every view: what follows allocates nothing while the scene stays the same.
    if (ensureBytes(device, buffer_, draws.size() * sizeof(DrawCommand) * kViewsPerRing, "draw commands")) next_ = 0;
    const std::size_t bytes = commands_.size() * sizeof(DrawCommand);
    if (next_ + bytes > buffer_.bytes()) next_ = 0;
    offset_ = next_;
    buffer_.write(offset_, std::as_bytes(std::span<const DrawCommand>(commands_)));
    next_ += bytes;
}

}  // namespace shoal::frame
