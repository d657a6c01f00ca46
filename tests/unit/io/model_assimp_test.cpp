// Formats other than glTF: small files written here, one a property of the format.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <shoal/core/pose.h>
#include <shoal/io/image.h>
#include <shoal/io/model.h>

#include "unit/io/gltf_builder.h"

namespace shoal {
namespace {

class ModelAssimp : public testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  (std::string("shoal_model_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path write(const std::string& name, const std::string& content) const {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }
    Model read(const std::filesystem::path& path, const io::ModelReadOptions& options = {}) const {
        Result<Model> model = io::readModel(path, options);
        EXPECT_TRUE(model.has_value()) << (model ? "" : model.error().message);
        return model ? *std::move(model) : Model{};
    }
    std::string fault(const std::filesystem::path& path) const {
        const Result<Model> model = io::readModel(path);
        return model ? "no error" : model.error().message;
    }
    std::filesystem::path folder_;
};

Bounds boundsOf(const Model& model) {
    Pose pose;
    poseModel(model, -1, 0, false, pose);
    return posedBounds(model, pose);
}

// A box from (0,0,0) to (1,2,3), without normals.
const char* const kBoxObj = R"(mtllib box.mtl
o box
v 0 0 0
v 1 0 0
v 1 2 0
v 0 2 0
v 0 0 3
v 1 0 3
v 1 2 3
v 0 2 3
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl paint
f 1/1 4/4 3/3 2/2
f 5/1 6/2 7/3 8/4
f 1/1 2/2 6/3 5/4
f 4/1 8/4 7/3 3/2
f 1/1 5/2 8/3 4/4
f 2/1 3/2 7/3 6/4
)";

TEST_F(ModelAssimp, ObjWithMaterialAndTexture) {
    write("box.mtl", "newmtl paint\nKd 0.5 0.25 0.125\nNs 250\nd 0.5\nmap_Kd box.png\n");
    const auto& png = test::smallPng();
    write("box.png", std::string(png.begin(), png.end()));
    const Model m = read(write("box.obj", kBoxObj));
    const ModelCounts counts = count(m);
    EXPECT_EQ(counts.drawnTriangles, 12u);
    EXPECT_EQ(counts.vertices, 24u);  // edges sharper than the crease angle stay edges
    EXPECT_NEAR(boundsOf(m).hi.z, 3, 1e-5);
    ASSERT_EQ(m.images.size(), 1u);
    EXPECT_EQ(m.images[0].width, 2);
    const Primitive* p = nullptr;
    for (const ModelMesh& mesh : m.meshes)
        for (const Primitive& each : mesh.primitives) p = &each;
    ASSERT_TRUE(p);
    const Material& paint = m.materials.at(std::size_t(p->material));
    EXPECT_EQ(paint.name, "paint");
    EXPECT_EQ(paint.baseColor, (Vec4{0.5f, 0.25f, 0.125f, 0.5f}));
    EXPECT_EQ(paint.alphaMode, AlphaMode::blend);
    EXPECT_NEAR(paint.roughness, 0.5, 1e-5);
    EXPECT_EQ(paint.metallic, 0);
    EXPECT_EQ(paint.baseColorTexture.image, 0);
    for (std::size_t i = 0; i < p->vertexCount(); ++i) {
        EXPECT_NEAR(length(p->normals[i]), 1, 1e-5);
        // OBJ's v counts up, ours down: the corner (0, 0, 0) of the front face has vt (0, 0).
        if (p->positions[i] == Vec3{0, 0, 3} && p->normals[i].z > 0.9f) {
            EXPECT_EQ(p->uv0[i], (Vec2{0, 1}));
        }
    }
}

TEST_F(ModelAssimp, ObjWithoutItsTextureIsStillRead) {
    write("box.mtl", "newmtl paint\nKd 0.5 0.25 0.125\nmap_Kd C:\\art\\lost.png\n");
    std::string log;
    io::ModelReadOptions options;
    options.log = [&](LogLevel, std::string_view message) { log += message; };
    const Model m = read(write("box.obj", kBoxObj), options);
    EXPECT_EQ(count(m).drawnTriangles, 12u);
    EXPECT_TRUE(m.images.empty());
    EXPECT_NE(log.find("lost.png"), std::string::npos) << log;
}

TEST_F(ModelAssimp, OptionsTurnAndScale) {
    io::ModelReadOptions options;
    options.up = io::UpAxis::z;
    options.scale = 0.1f;
    const Bounds bounds = boundsOf(read(write("box.obj", kBoxObj), options));
    EXPECT_NEAR(bounds.hi.y, 0.3, 1e-5);
    EXPECT_NEAR(bounds.lo.z, -0.2, 1e-5);
    EXPECT_NEAR(bounds.hi.x, 0.1, 1e-5);
}

TEST_F(ModelAssimp, PlyWithColors) {
    const Model m = read(write("tetra.ply", R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 4
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 255 0
0 1 0 0 0 255
0 0 1 188 188 188
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)"));
    ASSERT_EQ(count(m).drawnTriangles, 4u);
    const Primitive& p = m.meshes.at(0).primitives.at(0);
    ASSERT_EQ(p.colors.size(), p.vertexCount());
    for (std::size_t i = 0; i < p.vertexCount(); ++i)
        if (p.positions[i] == Vec3{0, 0, 1}) {
            EXPECT_NEAR(p.colors[i].x, 0.5, 0.01);  // 188 is half the light
        }
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {  // no rounding off of a tetrahedron's edges
        const Vec3 a = p.positions[p.indices[i]], b = p.positions[p.indices[i + 1]], c = p.positions[p.indices[i + 2]];
        const Vec3 n = normalize(cross(b - a, c - a));
        for (std::size_t k = i; k < i + 3; ++k) EXPECT_GT(dot(p.normals[p.indices[k]], n), 0.99f);
    }
}

// A ring of 24 quads turns by 15 degrees an edge: smooth along it, sharp where its flat lid begins.
TEST_F(ModelAssimp, SmoothsCurvesAndKeepsEdges) {
    std::string obj;
    const int sides = 24;
    for (int i = 0; i < sides; ++i)
        for (const int y : {0, 1})
            obj += fmt::format("v {} {} {}\n", std::cos(2 * kPiD * i / sides), y, std::sin(2 * kPiD * i / sides));
    std::string lid = "f";
    for (int i = 0; i < sides; ++i) {
        const int a = 2 * i + 1, b = 2 * ((i + 1) % sides) + 1;
        obj += fmt::format("f {} {} {} {}\n", a, a + 1, b + 1, b);
        lid += fmt::format(" {}", 2 * (sides - 1 - i) + 2);
    }
    const Model m = read(write("can.obj", obj + lid + "\n"));
    const Primitive& p = m.meshes.at(0).primitives.at(0);
    EXPECT_EQ(p.vertexCount(), 3u * sides);
    for (std::size_t i = 0; i < p.vertexCount(); ++i) {
        const Vec3 n = p.normals[i], at = p.positions[i];
        if (n.y > 0.5f) {
            EXPECT_NEAR(n.y, 1, 1e-5);
        } else {
            EXPECT_NEAR(dot(n, {at.x, 0, at.z}), 1, 1e-4);
        }
    }
}

std::string binaryStl(std::uint32_t claimed) {
    std::string out(80, ' ');
    out.append(reinterpret_cast<const char*>(&claimed), 4);
    const float triangle[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    out.append(reinterpret_cast<const char*>(triangle), sizeof triangle);
    return out + std::string(2, '\0');
}

TEST_F(ModelAssimp, Stl) {
    EXPECT_EQ(count(read(write("one.stl", binaryStl(1)))).drawnTriangles, 1u);
    EXPECT_NE(fault(write("many.stl", binaryStl(4000000000u))).find("many.stl: truncated: 4000000000 triangles need"),
              std::string::npos);
}

// A triangle with a skin of one joint would need a page of FBX; unit and axes are what differs between writers.
std::string asciiFbx(double unit, int upAxis) {
    return fmt::format(R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {{
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}}
GlobalSettings:  {{
	Version: 1000
	Properties70:  {{
		P: "UpAxis", "int", "Integer", "",{}
		P: "UpAxisSign", "int", "Integer", "",1
		P: "FrontAxis", "int", "Integer", "",{}
		P: "FrontAxisSign", "int", "Integer", "",{}
		P: "CoordAxis", "int", "Integer", "",0
		P: "CoordAxisSign", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",{}
	}}
}}
Definitions:  {{
	Version: 100
	Count: 2
}}
Objects:  {{
	Geometry: 1000, "Geometry::tri", "Mesh" {{
		Vertices: *9 {{
			a: 0,0,0,1,0,0,0,0,5
		}}
		PolygonVertexIndex: *3 {{
			a: 0,1,-3
		}}
		GeometryVersion: 124
	}}
	Model: 2000, "Model::tri", "Mesh" {{
		Version: 232
	}}
}}
Connections:  {{
	C: "OO",1000,2000
	C: "OO",2000,0
}}
)",
                       upAxis, upAxis == 2 ? 1 : 2, upAxis == 2 ? -1 : 1, unit);
}

TEST_F(ModelAssimp, FbxUnitAndUpAxis) {
    const Bounds centimetres = boundsOf(read(write("cm.fbx", asciiFbx(1, 1))));
    EXPECT_NEAR(centimetres.hi.x, 0.01, 1e-6);
    EXPECT_NEAR(centimetres.hi.z, 0.05, 1e-6);
    const Bounds metres = boundsOf(read(write("m.fbx", asciiFbx(100, 1))));
    EXPECT_NEAR(metres.hi.x, 1, 1e-5);
    const Bounds zUp = boundsOf(read(write("z.fbx", asciiFbx(100, 2))));
    EXPECT_NEAR(zUp.hi.x, 1, 1e-5);
    EXPECT_NEAR(zUp.hi.y, 5, 1e-5);
    EXPECT_NEAR(zUp.hi.z, 0, 1e-5);
    io::ModelReadOptions asY;
    asY.up = io::UpAxis::y;
    EXPECT_NEAR(boundsOf(read(folder_ / "z.fbx", asY)).hi.z, 5, 1e-5);
}

std::string collada(const char* unit, const char* up) {
    return fmt::format(R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{}" name="u"/><up_axis>{}</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 0 5</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)",
                       unit, up);
}

TEST_F(ModelAssimp, ColladaUnitAndUpAxis) {
    const Bounds zUp = boundsOf(read(write("z.dae", collada("0.1", "Z_UP"))));
    EXPECT_NEAR(zUp.hi.x, 0.1, 1e-5);
    EXPECT_NEAR(zUp.hi.y, 0.5, 1e-5);
    io::ModelReadOptions options;
    options.scale = 2;
    options.up = io::UpAxis::y;
    const Bounds forced = boundsOf(read(folder_ / "z.dae", options));
    EXPECT_NEAR(forced.hi.x, 2, 1e-4);
    EXPECT_NEAR(forced.hi.z, 10, 1e-4);
}

// One second of a node that moves by 4 along x, and back to the node tree it hangs in.
TEST_F(ModelAssimp, ColladaAnimation) {
    const auto source = [](const char* id, const char* name, int count, int stride, const char* values) {
        return fmt::format(
            R"(<source id="{0}"><float_array id="{0}a" count="{1}">{2}</float_array><technique_common>)"
            R"(<accessor source="#{0}a" count="{3}" stride="{4}"><param name="{5}" type="float"/></accessor>)"
            R"(</technique_common></source>)",
            id, count * stride, values, count, stride, name);
    };
    std::string text = collada("1", "Y_UP");
    text = test::replaced(text, R"(<node id="n">)", R"(<node id="n" sid="n"><translate sid="t">0 0 0</translate>)");
    text = test::replaced(
        text, "<library_visual_scenes>",
        "<library_animations><animation id=\"a\">" + source("time", "TIME", 2, 1, "0 1") +
            source("move", "X", 2, 1, "0 4") +
            R"(<source id="how"><Name_array id="howa" count="2">LINEAR LINEAR</Name_array><technique_common>)"
            R"(<accessor source="#howa" count="2" stride="1"><param name="INTERPOLATION" type="name"/></accessor>)"
            R"(</technique_common></source><sampler id="s1"><input semantic="INPUT" source="#time"/>)"
            R"(<input semantic="OUTPUT" source="#move"/><input semantic="INTERPOLATION" source="#how"/></sampler>)"
            R"(<channel source="#s1" target="n/t.X"/></animation></library_animations><library_visual_scenes>)");
    const Model m = read(write("move.dae", text));
    ASSERT_EQ(m.clips.size(), 1u);
    EXPECT_NEAR(m.clips[0].duration, 1, 1e-4);
    Pose pose;
    poseModel(m, 0, 0.5f, false, pose);
    EXPECT_NEAR(posedBounds(m, pose).lo.x, 2, 1e-3);
}

TEST_F(ModelAssimp, BadFilesGiveOneLine) {
    EXPECT_NE(
        fault(write("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n1\n"))
            .find("a.ply: PLY element count 4000000000, but only"),
        std::string::npos);
    EXPECT_NE(fault(write("b.ply", "no ply")).find("b.ply: not a PLY file"), std::string::npos);
    EXPECT_NE(fault(write("c.obj", "v 0 0 0\nv 1 0 0\np 1 2\n")).find("c.obj: has no triangles"), std::string::npos);
    EXPECT_NE(fault(write("f.off", "OFF\n# many\n3 2000000000 0\n")).find("f.off: OFF count of faces"),
              std::string::npos);
    EXPECT_NE(fault(write("d.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")).find("d.obj: "), std::string::npos);
    EXPECT_NE(fault(write("e.fbx", "garbage")).find("e.fbx: "), std::string::npos);
    for (const char* name : {"a.ply", "b.ply", "c.obj", "d.obj", "e.fbx", "f.off"})
        EXPECT_EQ(fault(folder_ / name).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace shoal
