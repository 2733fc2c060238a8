#include "core/render/timings_csv.h"

#include <clocale>
#include <gtest/gtest.h>
#include <locale>
#include <sstream>
#include <sys/stat.h>
#include <thread>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace hybridrt {
namespace {

// As documented; more columns may follow.
constexpr const char* kHeader =
    "frame,shadow_map_ms,id_ms,mark_ms,readback_ms,trace_ms,upload_ms,shade_ms,download_ms,write_ms,wall_ms,"
    "pixels_hit,pixels_marked,pixels_reflective,pixels_refractive,shadow_rays,reflection_rays,refraction_"
    "rays,"
    "shadow_cpu_ms,secondary_cpu_ms";

Frame numbered(int number) {
  Frame frame;
  frame.number = number;
  return frame;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

class TimingsCsvTest : public testing::Test {
 protected:
  std::string path() const { return (folder_.path / "timings.csv").string(); }
  std::vector<std::string> lines() const { return lines_of(file_contents(path())); }
  TemporaryFolder folder_;
};

TEST_F(TimingsCsvTest, HeaderAndEveryColumn) {
  Frame frame = numbered(12);
  for (size_t i = 0; i < frame.timings.pass_ms.size(); ++i) frame.timings.pass_ms[i] = 10.5 + static_cast<double>(i);
  frame.timings.wall_ms = 99.25;
  frame.stats = {21, 22, 23, 24, 25, 26, 27, 28, 29.5, 30.5, 31, 32, 33.5};
  TimingsCsv csv(path());
  csv.add(frame, 1);
  csv.file_written(12, 7.125);
  csv.finish();
  ASSERT_EQ(lines().size(), 2u);
  EXPECT_EQ(lines()[0].substr(0, std::string(kHeader).size()), kHeader);
  const std::vector<std::string> names = fields_of(lines()[0]), values = fields_of(lines()[1]);
  ASSERT_EQ(names.size(), values.size());
  std::map<std::string, double> row;
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(values[i].find_first_not_of("0123456789."), std::string::npos) << values[i];
    row[names[i]] = std::stod(values[i]);
  }
  EXPECT_EQ(row.size(), names.size()) << "a name occurs twice";
  const std::map<std::string, double> expected = {
      {"frame", 12},           {"shadow_map_ms", 10.5},   {"id_ms", 11.5},           {"mark_ms", 12.5},
      {"readback_ms", 13.5},   {"trace_ms", 14.5},        {"upload_ms", 15.5},       {"shade_ms", 16.5},
      {"download_ms", 17.5},   {"write_ms", 7.125},       {"wall_ms", 99.25},        {"pixels_hit", 21},
      {"pixels_marked", 22},   {"pixels_reflective", 23}, {"pixels_refractive", 24}, {"shadow_rays", 25},
      {"reflection_rays", 27}, {"refraction_rays", 28},   {"shadow_cpu_ms", 29.5},   {"secondary_cpu_ms", 30.5},
      {"pixels_suspect", 31},  {"pixels_repaired", 32},   {"repair_ms", 33.5}};
  for (const auto& [name, value] : expected) EXPECT_EQ(row.at(name), value) << name;
}

TEST_F(TimingsCsvTest, RowsComeInTheOrderOfDeliveryHoweverFilesAreWritten) {
  TimingsCsv csv(path());
  for (int frame : {5, 1, 9}) csv.add(numbered(frame), 2);
  csv.file_written(9, 1);
  csv.file_written(1, 2);
  csv.file_written(9, 3);
  csv.file_written(5, 4);
  csv.file_written(1, 5);
  csv.file_written(5, 6);
  EXPECT_EQ(csv.written_ms(), 21);
  csv.finish();
  const std::vector<std::string> rows = lines();
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(fields_of(rows[1])[0], "5");
  EXPECT_EQ(fields_of(rows[2])[0], "1");
  EXPECT_EQ(fields_of(rows[3])[0], "9");
  EXPECT_EQ(std::stod(fields_of(rows[1])[9]), 10) << "write_ms is the sum over the frame's files";
}

TEST_F(TimingsCsvTest, ARowAppearsOnlyWithItsFiles) {
  TimingsCsv csv(path());
  csv.add(numbered(1), 1);
  csv.add(numbered(2), 1);
  csv.file_written(2, 1);
  csv.finish();
  EXPECT_EQ(lines().size(), 1u) << "frame 1 is not written, and frame 2 comes after it";
}

// A run may be killed before it finishes.
TEST_F(TimingsCsvTest, TheFirstRowIsThereAtOnce) {
  {
    TimingsCsv csv(path());
    EXPECT_FALSE(std::filesystem::exists(path()));
    EXPECT_EQ(folder_.names().size(), 1u) << "it grows under a temporary name";
    csv.add(numbered(1), 1);
    EXPECT_FALSE(std::filesystem::exists(path())) << "the frame's file is not written";
    csv.file_written(1, 1);
    ASSERT_EQ(lines().size(), 2u);
    EXPECT_EQ(fields_of(lines()[1]).size(), fields_of(lines()[0]).size());
  }
  EXPECT_EQ(folder_.names(), std::set<std::string>{"timings.csv"}) << "the temporary file is left behind";
  EXPECT_EQ(lines().size(), 2u);
}

// A run that goes on with another's frames may be killed too.
TEST_F(TimingsCsvTest, EarlierRowsStayUntilTheirFramesCome) {
  {
    TimingsCsv csv(path());
    for (const int frame : {1, 2, 3, 4}) csv.add(numbered(frame), 0);
    csv.finish();
  }
  const std::vector<std::string> before = lines();
  const auto frames = [&] {
    std::vector<int> numbers;
    for (const std::string& line : lines())
      if (line != before[0]) numbers.push_back(std::stoi(line));
    return numbers;
  };
  TimingsRows rows = *read_timings_rows(path());
  ASSERT_EQ(rows.size(), 4u);
  TimingsCsv csv(path(), rows);
  csv.start();
  EXPECT_EQ(lines(), before);
  csv.add_earlier(2);
  csv.add(numbered(9), 0);
  EXPECT_EQ(frames(), (std::vector{2, 9, 1, 3, 4}));
  csv.add(numbered(3), 0);
  csv.add_earlier(1);
  csv.add_earlier(7);
  csv.finish();
  EXPECT_EQ(frames(), (std::vector{2, 9, 3, 1})) << "4 did not come";
  EXPECT_EQ(lines()[1], before[2]);
}

TEST_F(TimingsCsvTest, AFileWithoutRowsTellsThatARunBegan) {
  EXPECT_FALSE(read_timings_rows(path()));
  {
    TimingsCsv csv(path());
    csv.start();
  }
  EXPECT_EQ(lines().size(), 1u);
  ASSERT_TRUE(read_timings_rows(path()));
  EXPECT_TRUE(read_timings_rows(path())->empty());
}

TEST_F(TimingsCsvTest, RowsAreWholeWheneverOneLooks) {
  TimingsCsv csv(path());
  size_t seen = 0, growths = 0, frames = 0;
  while (frames < 3000 || (growths < 2 && frames < 300000)) {  // the slower the disk, the rarer it grows
    const int frame = static_cast<int>(++frames);
    csv.add(numbered(frame), 0);
    if (frame % 10 != 1) continue;
    const std::string text = file_contents(path());
    ASSERT_EQ(text.back(), '\n');
    const std::vector<std::string> now = lines_of(text);
    ASSERT_EQ(fields_of(now.back()).size(), fields_of(now.front()).size());
    ASSERT_EQ(fields_of(now.back())[0], std::to_string(now.size() - 1));
    growths += now.size() > seen;
    seen = now.size();
    if (frame % 500 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_GT(growths, 1u) << "it grows on the way";
  csv.finish();
  EXPECT_EQ(lines().size(), frames + 1);
  EXPECT_EQ(folder_.names(), std::set<std::string>{"timings.csv"});
}

TEST_F(TimingsCsvTest, ManyRowsTakeNoQuadraticTime) {
  TimingsCsv csv(path());
  for (int frame = 1; frame <= 200'000; ++frame) csv.add(numbered(frame), 0);  // copying at each row would take an hour
  csv.finish();
  EXPECT_GT(std::filesystem::file_size(path()), 10'000'000u);
}

TEST_F(TimingsCsvTest, AnOlderFileStaysUntilTheNewOneIsWhole) {
  std::ofstream(path()) << "old\n";
  { TimingsCsv unfinished(path()); }
  EXPECT_EQ(file_contents(path()), "old\n");
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// A locale like de_DE, which few machines have installed.
TEST_F(TimingsCsvTest, LocaleDoesNotReachTheNumbers) {
  const std::string c_before = std::setlocale(LC_ALL, nullptr);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // if it is installed
  Frame frame = numbered(12345);
  frame.timings.wall_ms = 1234.5;
  TimingsCsv csv(path());
  csv.add(frame, 0);
  csv.finish();
  std::locale::global(before);
  std::setlocale(LC_ALL, c_before.c_str());
  EXPECT_EQ(fields_of(lines()[1])[0], "12345");
  EXPECT_EQ(std::stod(fields_of(lines()[1])[10]), 1234.5) << lines()[1];
  EXPECT_EQ(fields_of(lines()[0]).size(), fields_of(lines()[1]).size());
}

TEST_F(TimingsCsvTest, UnwritablePlacesAreNamed) {
  std::ofstream(folder_.path / "file") << "x";
  for (const std::filesystem::path& place : {folder_.path / "file" / "t.csv", folder_.path}) {
    try {
      TimingsCsv csv(place.string());
      csv.finish();
      ADD_FAILURE() << place << " was written";
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::output);
      EXPECT_NE(std::string(failure.what()).find(place.string()), std::string::npos) << failure.what();
    }
  }
}

TEST_F(TimingsCsvTest, MissingFoldersAreMade) {
  const std::filesystem::path deep = folder_.path / "a" / "b" / "t.csv";
  TimingsCsv csv(deep.string());
  csv.finish();
  EXPECT_TRUE(std::filesystem::exists(deep));
}

// Not replaced by a file: a named pipe stands for everything that is not a file.
TEST_F(TimingsCsvTest, PipesAreWrittenStraight) {
  const std::string pipe = (folder_.path / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = file_contents(pipe); });
  {
    TimingsCsv csv(pipe);
    csv.add(numbered(3), 0);
    csv.finish();
  }
  reader.join();
  EXPECT_EQ(lines_of(read).size(), 2u);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(TimingsCsvTest, FullDevicesAreSaid) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  try {
    TimingsCsv csv("/dev/full");
    csv.finish();
    ADD_FAILURE() << "nothing was said";
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::output);
    EXPECT_NE(std::string(failure.what()).find("No space left"), std::string::npos) << failure.what();
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(TimingsCsvTest, ManyThreadsMayReport) {
  TimingsCsv csv(path());
  constexpr int kFrames = 400;
  for (int frame = 1; frame <= kFrames; ++frame) csv.add(numbered(frame), 2);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&csv, t] {
      for (int i = t; i < 2 * kFrames; i += 4) csv.file_written(i / 2 + 1, 0.5);
    });
  for (std::thread& thread : threads) thread.join();
  csv.finish();
  EXPECT_EQ(csv.written_ms(), kFrames);
  const std::vector<std::string> rows = lines();
  ASSERT_EQ(rows.size(), kFrames + 1u);
  for (int frame = 1; frame <= kFrames; ++frame) EXPECT_EQ(fields_of(rows[frame])[0], std::to_string(frame));
}

}  // namespace
}  // namespace hybridrt
