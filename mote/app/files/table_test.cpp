#include "mote/app/files/table.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mote/base/refusal.hpp"

namespace mote {
namespace {

std::string refusal_of(const std::string& text) {
  try {
    parse_table("d.csv", text);
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.code(), ExitCode::kBadData);
    return refusal.what();
  }
  return "";
}

TEST(ParseTable, KeepsFieldsAndTheirLines) {
  const Table table = parse_table("d.csv", "\xEF\xBB\xBF\n\"t\" , y\r\n 1 ,\"2.5\"\r\n\n\n3,\n");
  EXPECT_EQ(table.header, (std::vector<std::string>{"t", "y"}));
  EXPECT_EQ(table.header_line, 2U);
  ASSERT_EQ(table.lines.size(), 2U);
  EXPECT_EQ(table.where(table.lines[0]), "d.csv:3");
  EXPECT_EQ(table.where(table.lines[1]), "d.csv:6");
  EXPECT_EQ(number_field(table, table.lines[0], 1), 2.5);
  EXPECT_TRUE(std::isnan(number_field(table, table.lines[1], 1)));
  EXPECT_EQ(table.column("y"), 1U);
  EXPECT_FALSE(table.column("z"));
}

// Fields are views into the table's text: they must survive its being moved about.
TEST(ParseTable, MayBeMoved) {
  std::vector<Table> tables;
  for (int i = 0; i < 10; ++i) tables.push_back(parse_table("d.csv", "t,y\n1," + std::to_string(i) + "\n"));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(number_field(tables[i], tables[i].lines[0], 1), i);
}

TEST(ParseTable, RefusesByFileAndLine) {
  EXPECT_TRUE(refusal_of("").starts_with("d.csv: expected a header line"));
  EXPECT_TRUE(refusal_of("\n\nt,y\n").starts_with("d.csv:3: expected rows of data"));
  EXPECT_TRUE(refusal_of("t,y\n1,2\n3\n").starts_with("d.csv:3: expected 2 fields as in the header, got 1"));
  EXPECT_TRUE(refusal_of("t,y,y\n1,2,3\n").starts_with("d.csv:1: header: expected every column once, got \"y\" twice"));
  EXPECT_TRUE(refusal_of("x,y\n1,2\n").starts_with("d.csv:1: first column: expected \"t\", got \"x\""));
}

TEST(TimeField, IsAnIntegerFromOne) {
  const Table table = parse_table("d.csv", "t\n1\n2147483646\n0\n2147483647\n1.0\nnan\n");
  EXPECT_EQ(time_field(table, table.lines[0]), 1);
  EXPECT_EQ(time_field(table, table.lines[1]), 2147483646);
  for (std::size_t i = 2; i < table.lines.size(); ++i) EXPECT_THROW(time_field(table, table.lines[i]), Refusal);
}

}  // namespace
}  // namespace mote
