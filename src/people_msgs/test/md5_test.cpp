// SPDX-License-Identifier: BSD-3-Clause
// Wire compatibility: the MD5 sums of the public people_msgs.
#include <gtest/gtest.h>
#include <people_msgs/People.h>
#include <people_msgs/Person.h>
#include <people_msgs/PersonStamped.h>
#include <people_msgs/PositionMeasurement.h>
#include <people_msgs/PositionMeasurementArray.h>

namespace {

template <class Message>
const char* md5() {
  return ros::message_traits::MD5Sum<Message>::value();
}

TEST(Md5, People) { EXPECT_STREQ(md5<people_msgs::People>(), "18722f4b8db20cc2369740732357847b"); }
TEST(Md5, Person) { EXPECT_STREQ(md5<people_msgs::Person>(), "0b7c0818b76476f3863bd13f4d59f8df"); }
TEST(Md5, PersonStamped) {
  EXPECT_STREQ(md5<people_msgs::PersonStamped>(), "4a352a8b709eb9fec941a4f0f42651e7");
}
TEST(Md5, PositionMeasurement) {
  EXPECT_STREQ(md5<people_msgs::PositionMeasurement>(), "54fa938b4ec28728e01575b79eb0ec7c");
}
TEST(Md5, PositionMeasurementArray) {
  EXPECT_STREQ(md5<people_msgs::PositionMeasurementArray>(), "59c860d40aa739ec920eb3ad24ae019e");
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
