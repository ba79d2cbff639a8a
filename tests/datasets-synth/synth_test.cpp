// SPDX-FileCopyrightText: Copyright 2026 the pcl_bv authors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes by name: what is understood, what is refused and in which words.
#include "pcl_bv/synth/synth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace pcl_bv::detail {
namespace {

using testing::HasSubstr;

template <typename Parse>
std::string refusal(Parse parse, std::string_view text) {
  try {
    parse(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(ParseSynth, DefaultsAreTheDocumentedOnes) {
  for (const auto& [name, points] : {std::pair{"street", 128000u},
                                     {"sphere", 100000u},
                                     {"box", 100000u},
                                     {"gauss", 100000u},
                                     {"surface", 100000u},
                                     {"paper-7260", 7260u}}) {
    const SynthOptions spec = parse_synth(name);
    EXPECT_EQ(spec.name, name);
    EXPECT_EQ(spec.points, points);
    EXPECT_EQ(spec.seed, 1u);
  }
}

TEST(ParseSynth, ReadsPointsAndSeed) {
  const SynthOptions spec = parse_synth("gauss:12:18446744073709551615");
  EXPECT_EQ(spec.points, 12u);
  EXPECT_EQ(spec.seed, UINT64_MAX);
}

TEST(ParseSynth, StreetPointsAreRoundedToMultiplesOfTheBeams) {
  for (const auto& [asked, given] :
       {std::pair{"1", 64u}, {"64", 64u}, {"95", 64u}, {"96", 128u}, {"100000", 100032u}, {"6400", 6400u}}) {
    EXPECT_EQ(parse_synth(std::string("street:") + asked).points, given) << asked;
  }
}

TEST(ParseSynth, PaperScenesAcceptTheirOwnSizeOnly) {
  EXPECT_EQ(parse_synth("paper-4010:4010:9").seed, 9u);
  EXPECT_THAT(refusal(parse_synth, "paper-4010:4011"),
              HasSubstr("'4011' is not allowed: paper-4010 has 4010"));
}

TEST(ParseSynth, RefusalsNameTheValueAndWhatIsAllowed) {
  for (const std::string name : {"", "streets", "Street", " street", "paper-1"}) {
    const std::string reason = refusal(parse_synth, name);
    EXPECT_THAT(reason, HasSubstr("'" + name + "'"));
    EXPECT_THAT(reason, HasSubstr("street, sphere, box, gauss, surface, paper-4010"));
  }
  for (const std::string points :
       {"", "0", "-1", "+5", "1e5", "2000000001", "99999999999999999999999", "5 "}) {
    const std::string reason = refusal(parse_synth, "box:" + points);
    EXPECT_THAT(reason, HasSubstr("POINTS '" + points + "' is not a whole number from 1 to 2000000000"));
  }
  for (const std::string seed : {"", "-1", "x", "18446744073709551616"}) {
    EXPECT_THAT(refusal(parse_synth, "box:5:" + seed), HasSubstr("SEED '" + seed + "'"));
  }
  EXPECT_THAT(refusal(parse_synth, "box:5:1:1"), HasSubstr("box[:POINTS[:SEED]]"));
}

TEST(ParseRuralRoadSequence, ReadsBeamsFramesAndSeed) {
  EXPECT_EQ(parse_rural_road_sequence("rural-road-sequence").options.beams, 64u);
  EXPECT_EQ(parse_rural_road_sequence("rural-road-sequence").frames, 100u);
  EXPECT_EQ(parse_rural_road_sequence("rural-road-sequence").options.seed, 1u);
  for (const std::size_t beams : {16u, 32u, 64u, 128u}) {
    const auto spec = parse_rural_road_sequence("rural-road-sequence-" + std::to_string(beams) + ":3:4");
    EXPECT_EQ(spec.options.beams, beams);
    EXPECT_EQ(spec.frames, 3u);
    EXPECT_EQ(spec.options.seed, 4u);
  }
  EXPECT_TRUE(is_rural_road_sequence("rural-road-sequence-7:1"));
  EXPECT_FALSE(is_rural_road_sequence("rural-road"));
  EXPECT_FALSE(is_rural_road_sequence("street-sequence:rural-road-sequence"));
}

TEST(ParseRuralRoadSequence, RefusalsNameTheValueAndWhatIsAllowed) {
  for (const std::string name : {"rural-road-sequence-", "rural-road-sequence-17", "rural-road-sequences",
                                 "rural-road-sequence16", "rural-road"}) {
    const std::string reason = refusal(parse_rural_road_sequence, name);
    EXPECT_THAT(reason, HasSubstr("'" + name + "'"));
    EXPECT_THAT(reason, HasSubstr("[-16|-32|-64|-128]"));
  }
  EXPECT_THAT(refusal(parse_rural_road_sequence, "rural-road-sequence:0"), HasSubstr("FRAMES '0'"));
  EXPECT_THAT(refusal(parse_rural_road_sequence, "rural-road-sequence-16:1:2:3"),
              HasSubstr("[:FRAMES[:SEED]]"));
}

TEST(MakeSynth, TheRuralRoadHasAsManyPointsAsParsingSays) {
  for (const char* const name : {"rural-road", "rural-road-16", "rural-road-32", "rural-road-128"})
    EXPECT_EQ(make_synth(parse_synth(name)).size(), parse_synth(name).points) << name;
  EXPECT_THAT(refusal(parse_synth, "rural-road:5"), HasSubstr("rural-road has 128000 points"));
}

TEST(MakeSynth, VergesIsAnAliasOfTheRuralRoad) {
  for (const std::string sensor : {"", "-16", "-32", "-128"}) {
    const SynthOptions old_name =
        parse_synth("verges" + sensor + ":" + std::to_string(parse_synth("verges" + sensor).points) + ":5");
    const SynthOptions spec = parse_synth("rural-road" + sensor);
    EXPECT_EQ(old_name.name, "rural-road" + sensor);
    EXPECT_EQ(old_name.points, spec.points);
    EXPECT_EQ(old_name.seed, 5u);
  }
  const SynthCloud cloud = make_synth(parse_synth("rural-road-16"));
  EXPECT_EQ(make_synth(parse_synth("verges-16")).xyz, cloud.xyz);
  EXPECT_EQ(make_synth({"verges-16", 28'800, 1}).xyz, cloud.xyz);
  EXPECT_EQ(synth_names().find("verges"), std::string::npos);
  for (const std::string name : {"verges-", "verges-17", "vergesx", "verges-sequence"})
    EXPECT_THAT(refusal(parse_synth, name), HasSubstr("'" + name + "'"));
}

TEST(ParseRuralRoadSequence, VergesSequenceIsAnAlias) {
  const RuralRoadSequenceOptions spec = parse_rural_road_sequence("verges-sequence-16:3:4");
  EXPECT_EQ(spec.options.beams, 16u);
  EXPECT_EQ(spec.options.seed, 4u);
  EXPECT_EQ(spec.frames, 3u);
  EXPECT_EQ(parse_rural_road_sequence("verges-sequence").options.beams, 64u);
  EXPECT_TRUE(is_rural_road_sequence("verges-sequence-7:1"));
  EXPECT_FALSE(is_rural_road_sequence("verges"));
  EXPECT_FALSE(is_rural_road_sequence("street-sequence:verges-sequence"));
  EXPECT_THAT(refusal(parse_rural_road_sequence, "verges-sequence-17"), HasSubstr("'verges-sequence-17'"));
}

TEST(ParseStreetSequence, ReadsFramesAndSeed) {
  EXPECT_EQ(parse_street_sequence("street-sequence").frames, 22u);
  EXPECT_EQ(parse_street_sequence("street-sequence").seed, 1u);
  EXPECT_EQ(parse_street_sequence("street-sequence:3").frames, 3u);
  EXPECT_EQ(parse_street_sequence("street-sequence:3:4").seed, 4u);
}

TEST(ParseStreetSequence, RefusalsNameTheValueAndWhatIsAllowed) {
  EXPECT_THAT(refusal(parse_street_sequence, "street"), HasSubstr("'street', expected street-sequence"));
  EXPECT_THAT(refusal(parse_street_sequence, "street-sequence:0"),
              HasSubstr("FRAMES '0' is not a whole number"));
  EXPECT_THAT(refusal(parse_street_sequence, "street-sequence:1:2:3"), HasSubstr("[:FRAMES[:SEED]]"));
}

TEST(MakeSynth, EverySceneHasExactlyItsPointsAllFinite) {
  for (const char* name : {"street:6400", "sphere", "box:1", "gauss:17", "surface:100", "paper-30892"}) {
    SCOPED_TRACE(name);
    const SynthOptions spec = parse_synth(name);
    const SynthCloud cloud = make_synth(spec);
    EXPECT_EQ(cloud.size(), spec.points);
    for (const float coordinate : cloud.xyz)
      ASSERT_TRUE(std::isfinite(coordinate));
  }
}

TEST(MakeSynth, RefusesAnUnknownName) {
  EXPECT_THROW(make_synth({"no such scene", 10, 1}), std::invalid_argument);
}

std::vector<std::string> field_names(const RawCloud& cloud) {
  std::vector<std::string> names;
  for (const PointField& field : cloud.fields)
    names.push_back(field.name);
  return names;
}

std::uint32_t uint32_at(const RawCloud& cloud, std::size_t field, std::size_t point) {
  std::uint32_t value = 0;
  std::memcpy(&value, cloud.data.data() + point * cloud.point_step + cloud.fields[field].offset,
              sizeof value);
  return value;
}

TEST(ToRawCloud, AStreetIsARangeImageWithItsLabels) {
  const SynthCloud street = make_synth(parse_synth("street:6400"));
  const RawCloud raw = to_raw_cloud(street);
  EXPECT_EQ(field_names(raw), (std::vector<std::string>{"x", "y", "z", "object", "ground"}));
  EXPECT_EQ(raw.height, 64u);
  EXPECT_EQ(raw.width, 100u);
  EXPECT_EQ(raw.fields[3].type, 'U');
  for (std::size_t i = 0; i < street.size(); ++i) {
    const Coordinates p = load_point(raw.xyz(), i);
    ASSERT_EQ(p.x, street.xyz[3 * i]);
    ASSERT_EQ(p.y, street.xyz[3 * i + 1]);
    ASSERT_EQ(p.z, street.xyz[3 * i + 2]);
    ASSERT_EQ(uint32_at(raw, 3, i), street.object[i]);
    ASSERT_EQ(uint32_at(raw, 4, i), street.ground[i]);
  }
}

TEST(ToRawCloud, AShapeIsOneRowOfCoordinates) {
  const RawCloud raw = to_raw_cloud(make_synth(parse_synth("gauss:100")));
  EXPECT_EQ(field_names(raw), (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(raw.width, 100u);
  EXPECT_EQ(raw.height, 1u);
}

}  // namespace
}  // namespace pcl_bv::detail
