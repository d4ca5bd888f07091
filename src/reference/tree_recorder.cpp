#include "reference/tree_recorder.hpp"

namespace packtrace::reference {

// A child may be added while only its ancestors are open, none of which moves.
TreeRecorder::Traced TreeRecorder::begin_ray(const Rgb& org, const Rgb& dir) const
{
    RayNode* node = &growth_->root;
    if (!growth_->open.empty()) {
        const Rgb weight = now().weight * growth_->factor;
        node = &now().children.emplace_back();
        node->weight = weight;
        node->kind = growth_->next;
    }
    node->org = org;
    node->dir = dir;
    growth_->open.push_back(node);
    return Traced(*growth_);
}

}  // namespace packtrace::reference
