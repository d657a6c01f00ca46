// The eye that a person moves: orbit, pan, dolly and fly on a scene's own camera description, without inertia.
#pragma once

#include <shoal/core/math.h>
#include <shoal/light/view.h>
#include <shoal/scene/content.h>

namespace shoal::viewer {

enum class Side { front, back, left, right, top, bottom };

class ViewCamera {
public:
    // Goes back to what the scene itself says; its camera path or orbit plays until the eye is moved by hand.
    void follow() { free_ = false; }
    bool isFree() const { return free_; }
    // Takes the place and direction of `camera`; the pivot is as far as `pivotDistance`.
    void take(const light::Camera& camera, const scene::CameraSpec& spec, float pivotDistance);
    void set(const scene::CameraSpec& spec) { spec_ = spec, free_ = true; }
    const scene::CameraSpec& spec() const { return spec_; }
    void setFree() { free_ = true; }

    void orbit(float yaw, float pitch);                 // radians, about the pivot
    void look(float yaw, float pitch);                  // radians, about the eye
    void pan(float rightPx, float upPx, int heightPx);  // the pivot's surface follows the cursor
    void dolly(float steps);                            // towards the pivot, a tenth of the way a step
    void move(Vec3 rightUpAhead, float metres);         // eye and pivot together
    void frame(const Bounds& bounds, float aspect);     // all of it in the picture, from the direction it is seen from
    void lookFrom(Side side, const Bounds& bounds, float aspect);
    void toggleOrthographic();

    // As scene::cameraAt makes it of a fixed camera: the same bits as in a saved scene.
    light::Camera camera(const scene::Scene& scene, const scene::Content& content, float aspect) const;
    float pivotDistance() const { return length(spec_.position - spec_.target); }

private:
    struct Axes {
        Vec3 right, up, back, worldUp;
    };
    Axes axes() const;
    void turn(Vec3& offset, float yaw, float pitch) const;

    scene::CameraSpec spec_;
    bool free_ = false;
};

}  // namespace shoal::viewer
