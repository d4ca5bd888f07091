#include "reference/explain_reference.hpp"

#include "reference/reference.hpp"
#include "reference/tree_recorder.hpp"

namespace packtrace {

RayNode explain_reference(const Scene& scene, int x, int y)
{
    using reference::TreeRecorder;
    TreeRecorder::Growth growth;
    const reference::Reference<double, TreeRecorder> reference(scene, TreeRecorder(growth));
    (void)reference.trace_pixel(x, y);
    return growth.root;
}

}  // namespace packtrace
