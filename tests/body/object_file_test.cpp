// SPDX-License-Identifier: Apache-2.0
#include "body/object_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ifa {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

Json goodObject() {
  return Json::parse(R"({"format": "inverse-foley-object", "version": 1, "name": "d6",
    "title": "Six-sided die", "mesh": "d6.obj", "units": "mm", "kind": "solid", "mass": 0.0049,
    "material": "acrylic", "surfaces": {"desk": {"restitution": 0.82, "friction": 0.35,
    "rolling_friction": 0.0005, "spinning_friction": 0.0004, "reference_impulse": 0.003}},
    "default_surface": "desk", "sampling": {"cone_degrees": 40, "speed": [1, 3], "spin": [2, 9]},
    "merge_gap": 0.02, "faces": {"1": [0, 0, 1], "2": [0.6, 0.8, 0]}, "notes": "why"})");
}

Result<ObjectDefinition> parse(const Json& json) {
  return parseObjectFile(json.dump(), "/somewhere/x.json");
}

TEST(ObjectFile, IsReadInFull) {
  const auto d = parse(goodObject());
  ASSERT_TRUE(d) << d.error().text();
  EXPECT_EQ(d->name, "d6");
  EXPECT_EQ(d->meshPath, "/somewhere/d6.obj");
  EXPECT_EQ(d->units, "mm");
  EXPECT_DOUBLE_EQ(d->mass, 0.0049);
  EXPECT_DOUBLE_EQ(d->surfaces.at("desk").restitution, 0.82);
  EXPECT_DOUBLE_EQ(d->surfaces.at("desk").spinningFriction, 0.0004);
  EXPECT_DOUBLE_EQ(d->surfaces.at("desk").referenceImpulse, 0.003);
  EXPECT_DOUBLE_EQ(d->sampling.coneDegrees, 40);
  EXPECT_DOUBLE_EQ(d->sampling.spin[1], 9);
  EXPECT_DOUBLE_EQ(d->mergeGap, 0.02);
  EXPECT_LT((d->faces.at("2") - Eigen::Vector3d(0.6, 0.8, 0)).norm(), 1e-15);
}

TEST(ObjectFile, WriterAndReaderAgree) {
  Json composite = goodObject();
  composite.erase("mass");
  composite.erase("kind");
  composite["hull"] = "hull.obj";
  composite["parts"] = {{{"mesh", "a.obj"}, {"kind", "solid"}, {"density", 7800}},
                        {{"mesh", "b.obj"}, {"kind", "shell"}, {"mass", 0.01}}};
  Json dense = goodObject();
  dense.erase("mass");
  dense["density"] = 1190;
  for (const Json& json : {goodObject(), composite, dense}) {
    const auto first = parse(json);
    ASSERT_TRUE(first) << first.error().text();
    const std::string text = objectFileText(*first);
    const auto again = parseObjectFile(text, "/somewhere/x.json");
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(objectFileText(*again), text);
    Json written = Json::parse(text);
    EXPECT_EQ(written, json);
  }
}

struct Fault {
  const char* name;
  const char* patch;    // a JSON merge patch: null takes a field out
  const char* field;    // named in the error's place
  const char* message;  // part of the message
};

void PrintTo(const Fault& fault, std::ostream* stream) { *stream << fault.name; }

class FaultyObject : public testing::TestWithParam<Fault> {};

TEST_P(FaultyObject, NamesFileFieldAndFault) {
  Json json = goodObject();
  json.merge_patch(Json::parse(GetParam().patch));
  const auto d = parse(json);
  ASSERT_FALSE(d);
  EXPECT_EQ(d.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(d.error().place, std::string("/somewhere/x.json: ") + GetParam().field);
  EXPECT_THAT(d.error().message, HasSubstr(GetParam().message));
}

TEST(ObjectFile, AListOfSurfacesIsReadByWholeNames) {
  Json json = goodObject();
  json["surfaces"][std::string("desk\0s", 6)] = {{"restitution", 0.5}, {"friction", 0.3}};
  const auto d = parse(json);
  ASSERT_FALSE(d);
  EXPECT_THAT(d.error().message, HasSubstr("is not a plain name"));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, FaultyObject,
    testing::Values(
        Fault{"Format", R"({"format": "glTF"})", "format", "inverse-foley-object"},
        Fault{"NoVersion", R"({"version": null})", "version", "missing"},
        Fault{"Version", R"({"version": 2})", "version", "not known"},
        Fault{"NoName", R"({"name": null})", "name", "missing"},
        Fault{"Name", R"({"name": "../x"})", "name", "letters"},
        Fault{"NoMesh", R"({"mesh": null})", "mesh", "missing"},
        Fault{"MeshNumber", R"({"mesh": 3})", "mesh", "text"},
        Fault{"NoUnits", R"({"units": null})", "units", "missing"},
        Fault{"Units", R"({"units": "furlong"})", "units", "mm"},
        Fault{"Kind", R"({"kind": "liquid"})", "kind", "shell"},
        Fault{"NoMass", R"({"mass": null})", "mass", "missing"},
        Fault{"MassText", R"({"mass": "5 g"})", "mass", "number"},
        Fault{"MassNegative", R"({"mass": -1})", "mass", "not between"},
        Fault{"MassAbsurd", R"({"mass": 1e9})", "mass", "not between"},
        Fault{"MassTwice", R"({"density": 1000})", "density", "beside a mass"},
        Fault{"NoSurfaces", R"({"surfaces": null})", "surfaces", "missing"},
        Fault{"SurfacesList", R"({"surfaces": [1]})", "surfaces", "object"},
        Fault{"NoRestitution", R"({"surfaces": {"desk": {"restitution": null}}})",
              "surfaces.desk.restitution", "missing"},
        Fault{"Restitution", R"({"surfaces": {"desk": {"restitution": 1.2}}})",
              "surfaces.desk.restitution", "1.2 is not between 0 and 0.95"},
        Fault{"Friction", R"({"surfaces": {"desk": {"friction": -0.1}}})", "surfaces.desk.friction",
              "not between"},
        Fault{"Rolling", R"({"surfaces": {"desk": {"rolling_friction": 5}}})",
              "surfaces.desk.rolling_friction", "not between"},
        Fault{"Spinning", R"({"surfaces": {"desk": {"spinning_friction": true}}})",
              "surfaces.desk.spinning_friction", "number"},
        Fault{"Reference", R"({"surfaces": {"desk": {"reference_impulse": -1}}})",
              "surfaces.desk.reference_impulse", "not between"},
        Fault{"NoDefault", R"({"default_surface": null})", "default_surface", "missing"},
        Fault{"Default", R"({"default_surface": "moon"})", "default_surface", "moon"},
        Fault{"Cone", R"({"sampling": {"cone_degrees": 200}})", "sampling.cone_degrees", "between"},
        Fault{"Speed", R"({"sampling": {"speed": [4]}})", "sampling.speed", "two numbers"},
        Fault{"Spin", R"({"sampling": {"spin": [5, 1]}})", "sampling.spin", "larger number first"},
        Fault{"MergeGap", R"({"merge_gap": 7})", "merge_gap", "not between"},
        Fault{"FaceLength", R"({"faces": {"1": [0, 0, 3]}})", "faces.1", "length 1"},
        Fault{"FaceShort", R"({"faces": {"1": [0, 1]}})", "faces.1", "three numbers"},
        Fault{"Parts", R"({"mass": null, "parts": []})", "parts", "1 to 64"},
        Fault{"PartsAndMass", R"({"parts": [{"mesh": "a", "kind": "solid", "mass": 1}]})", "mass",
              "beside parts"},
        Fault{"PartMass", R"({"mass": null, "parts": [{"mesh": "a", "kind": "solid"}]})",
              "parts[0].mass", "missing"}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(ObjectFile, TextThatIsNoObjectFile) {
  for (const char* text : {"", "{", "[]", "42", "v 0 0 0\nf 1 2 3\n"}) {
    const auto d = parseObjectFile(text, "x.json");
    ASSERT_FALSE(d) << text;
    EXPECT_THAT(d.error().text(), HasSubstr("x.json"));
  }
  std::string deep(200'000, '[');
  EXPECT_FALSE(parseObjectFile(deep, "x.json"));
}

TEST(ObjectFile, MissingFileAndMissingMesh) {
  EXPECT_THAT(readObjectFile("/nonexistent.json").error().text(), HasSubstr("no such file"));
  const auto body = makeBody(*parse(goodObject()));
  ASSERT_FALSE(body);
  EXPECT_THAT(body.error().text(), HasSubstr("/somewhere/d6.obj: no such mesh file"));
}

TEST(Units, AreMetres) {
  EXPECT_EQ(metresPerUnit("mm"), 0.001);
  EXPECT_EQ(metresPerUnit("cm"), 0.01);
  EXPECT_EQ(metresPerUnit("in"), 0.0254);
  EXPECT_EQ(metresPerUnit("km"), 0);
}

}  // namespace
}  // namespace ifa
