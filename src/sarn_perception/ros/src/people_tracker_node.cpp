// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception_ros/people_tracker_node.h"

#include <people_msgs/People.h>
#include <ros/console.h>
#include <ros/names.h>
#include <sarn_msgs/TrackedPeople.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>

#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_perception_ros/conversions.h"
#include "sarn_perception_ros/topics.h"
#include "sarn_perception_ros/track_markers.h"

namespace sarn_perception {
namespace {

constexpr double kWarningPeriod = 5.0;       // [s] between two lines about the same thing
constexpr std::uint32_t kWaitingScans = 15;  // for their transform: half a second
constexpr std::uint32_t kWaitingImages = 5;
constexpr double kRounding = 1e-3;  // [s]

PerceptionParams perceptionParams(const ros::NodeHandle& nh) {
  PerceptionParams params;
  params.background = sarn::readParameters<BackgroundParams>(ros::NodeHandle(nh, "background"));
  params.legs = sarn::readParameters<LegParams>(ros::NodeHandle(nh, "legs"));
  params.bodies = sarn::readParameters<BodyParams>(ros::NodeHandle(nh, "bodies"));
  params.tracker = sarn::readParameters<TrackerParams>(ros::NodeHandle(nh, "tracker"));
  return params;
}

const char* text(tf2_ros::FilterFailureReason reason) {
  switch (reason) {
    case tf2_ros::filter_failure_reasons::OutTheBack:
      return "older than all that tf remembers";
    case tf2_ros::filter_failure_reasons::EmptyFrameID:
      return "the frame has no name";
    default:
      return "tf did not come in time";
  }
}

/// Whether something that happens at most at `rate` [Hz] is due; sets when it is next.
bool due(const ros::Time& stamp, double rate, ros::Time& next) {
  if (stamp + ros::Duration(kRounding) < next) return false;
  const ros::Duration period(1.0 / rate);
  const bool steady = !next.isZero() && next + period > stamp;
  next = (steady ? next : stamp) + period;
  return true;
}

}  // namespace

PeopleTrackerNode::PeopleTrackerNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : nh_(nh),
      params_(
          sarn::readParameters<PeopleTrackerParams>(private_nh, {"background", "legs", "bodies", "tracker"})),
      perception_(perceptionParams(private_nh)),
      listener_(transforms_),
      scans_(transforms_, params_.odom_frame, kWaitingScans, nh_),
      images_(transforms_, params_.odom_frame, kWaitingImages, nh_),
      people_publisher_(nh_.advertise<people_msgs::People>(kPeopleTopic, 10)),
      tracked_publisher_(nh_.advertise<sarn_msgs::TrackedPeople>(kTrackedPeopleTopic, 10)),
      marker_publisher_(nh_.advertise<visualization_msgs::MarkerArray>(kTrackMarkersTopic, 10)),
      lockstep_(nh_, kTrackerLockstepTopic) {
  scans_.registerCallback(&PeopleTrackerNode::track, this);
  scans_.registerFailureCallback(
      [this](const sensor_msgs::LaserScanConstPtr& scan, tf2_ros::FilterFailureReason reason) {
        ROS_WARN_STREAM_THROTTLE(kWarningPeriod, scan_subscriber_.getTopic()
                                                     << ": no transform from its frame '"
                                                     << scan->header.frame_id << "' to '"
                                                     << params_.odom_frame << "' at " << scan->header.stamp
                                                     << ": " << text(reason) << "; left out");
        lockstep_.acknowledge(scan->header.stamp);
      });
  map_subscriber_ = nh_.subscribe(kMapTopic, 1, &PeopleTrackerNode::takeMap, this);
  scan_subscriber_ =
      nh_.subscribe(kScanTopic, 10, &PeopleTrackerNode::takeScan, this, ros::TransportHints().tcpNoDelay());
  if (params_.use_bodies) {
    images_.registerCallback(&PeopleTrackerNode::lookForBodies, this);
    const std::string image_topic = nh_.resolveName(kImageTopic);
    const std::string info_topic =
        ros::names::append(ros::names::parentNamespace(image_topic), kCameraInfoName);
    image_subscriber_ = nh_.subscribe(image_topic, 2, &PeopleTrackerNode::takeImage, this);
    info_subscriber_ = nh_.subscribe<sensor_msgs::CameraInfo>(
        info_topic, 2, [this](const sensor_msgs::CameraInfoConstPtr& info) { camera_info_ = info; });
  }
  timer_ =
      nh_.createTimer(ros::Duration(1.0 / params_.rate), [this](const ros::TimerEvent&) { predictAlone(); });
}

void PeopleTrackerNode::takeMap(const nav_msgs::OccupancyGridConstPtr& map) {
  const auto values = sarn::fromMessage(*map);
  const bool right_frame = map->header.frame_id == params_.map_frame;
  if (!values || !right_frame) {
    const std::string problem =
        right_frame ? "its size, resolution or origin cannot be used"
                    : "its frame is '" + map->header.frame_id + "', not '" + params_.map_frame + "'";
    ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, map_subscriber_.getTopic()
                                                  << ": " << problem
                                                  << "; the last good map, if there is one, stays");
    return;
  }
  const double resolution = values->geometry.resolution;
  if (map_resolution_ && *map_resolution_ != resolution) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, map_subscriber_.getTopic()
                                                 << ": its cells measure " << resolution
                                                 << " m, before it were " << *map_resolution_
                                                 << " m; walls are taken from it as it is");
  }
  map_resolution_ = resolution;
  perception_.setMap(*values);
}

void PeopleTrackerNode::remark(const sensor_msgs::LaserScan& scan) {
  const std::string& topic = scan_subscriber_.getTopic();
  const std::size_t beams = scan.ranges.size();
  if (beam_count_ && *beam_count_ != beams) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": " << beams << " beams, before it were "
                                                   << *beam_count_ << "; taken as they are");
  }
  beam_count_ = beams;
  if (scan_frame_ && *scan_frame_ != scan.header.frame_id) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": frame '" << scan.header.frame_id
                                                   << "', before it was '" << *scan_frame_
                                                   << "'; taken as it is");
  }
  scan_frame_ = scan.header.frame_id;
  // +Inf is one: free up to range_max (REP 117).
  const auto says_something = [](float range) { return range >= 0.0F; };
  if (std::none_of(scan.ranges.begin(), scan.ranges.end(), says_something)) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": none of its " << beams
                                                   << " ranges is a distance (NaN, -Inf or negative); "
                                                      "people are only predicted");
  }
}

bool PeopleTrackerNode::usable(const std_msgs::Header& header, const std::string& topic) const {
  if (header.stamp.isZero()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": has no stamp; left out");
    return false;
  }
  const double ahead = (header.stamp - last_now_).toSec();
  if (ahead <= params_.max_future) return true;
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": stamp " << header.stamp << " is " << ahead
                                                 << " s ahead of the clock; left out");
  return false;
}

bool PeopleTrackerNode::ready(const std::string& topic) const {
  if (perception_.hasMap()) return true;
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": no map on " << map_subscriber_.getTopic()
                                                 << " yet, so walls cannot be told from people");
  return false;
}

void PeopleTrackerNode::watchClock() {
  const ros::Time now = ros::Time::now();
  if (now < last_now_) {
    ROS_WARN_STREAM("the clock jumped back from " << last_now_ << " to " << now << ": "
                                                  << perception_.tracker().tracks().size()
                                                  << " tracks forgotten");
    perception_.clear();
    scans_.clear();
    images_.clear();
    transforms_.clear();
    last_scan_ = last_image_ = next_publication_ = next_body_ = ros::Time();
  }
  last_now_ = now;
}

void PeopleTrackerNode::takeScan(const sensor_msgs::LaserScanConstPtr& scan) {
  watchClock();
  if (usable(scan->header, scan_subscriber_.getTopic())) {
    scans_.add(scan);
  } else {
    lockstep_.acknowledge(last_now_);
  }
}

void PeopleTrackerNode::takeImage(const sensor_msgs::ImageConstPtr& image) {
  watchClock();
  const std::string& topic = image_subscriber_.getTopic();
  if (!usable(image->header, topic)) return;
  if (image->header.stamp <= last_image_) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, topic << ": stamp " << image->header.stamp
                                                   << " is not newer than the last image; left out");
    return;
  }
  last_image_ = image->header.stamp;
  if (due(image->header.stamp, params_.body_rate, next_body_)) images_.add(image);
}

std::optional<sarn::Pose2D> PeopleTrackerNode::planar(const std::string& target, const std::string& source,
                                                      const ros::Time& stamp) const {
  try {
    const auto transform = transforms_.lookupTransform(target, source, stamp);
    if (const auto pose = sarn::fromMessage(transform.transform)) return pose;
    ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, "tf: '" << source << "' holds NaN or is tilted against '"
                                                      << target << "'; both must be level");
  } catch (const tf2::TransformException& error) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod,
                             "tf: no pose of '" << source << "' in '" << target << "': " << error.what());
  }
  return std::nullopt;
}

std::optional<sarn::Pose2D> PeopleTrackerNode::localization(const ros::Time& stamp) const {
  // The newest one: it changes slowly, and what localises the robot may work more slowly than this.
  const auto pose = planar(params_.map_frame, params_.odom_frame, ros::Time());
  if (!pose) return std::nullopt;
  const auto transform = transforms_.lookupTransform(params_.map_frame, params_.odom_frame, ros::Time());
  const double age = (stamp - transform.header.stamp).toSec();
  if (transform.header.stamp.isZero() || age <= params_.localization_timeout) return pose;
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "tf: '" << params_.odom_frame << "' in '" << params_.map_frame
                                                   << "' is " << age
                                                   << " s old; no scan is used until it is fresh");
  return std::nullopt;
}

void PeopleTrackerNode::track(const sensor_msgs::LaserScanConstPtr& scan) {
  const std::string& topic = scan_subscriber_.getTopic();
  const ros::Time& stamp = scan->header.stamp;
  const auto sensor = planar(params_.odom_frame, scan->header.frame_id, stamp);
  const auto map = sensor ? localization(stamp) : std::nullopt;
  if (map && ready(topic)) {
    try {
      if (perception_.takeScan(fromMessage(*scan), {*sensor, *map}, stamp.toSec())) {
        remark(*scan);
        last_scan_ = std::max(last_scan_, stamp);
        if (due(stamp, params_.rate, next_publication_)) publish(stamp, *map);
      } else {
        ROS_WARN_STREAM_THROTTLE(
            kWarningPeriod, topic << ": stamp " << stamp << " is not newer than the last scan; left out");
      }
    } catch (const ScanError& error) {
      ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, topic << ": " << error.what() << "; left out");
    }
  }
  lockstep_.acknowledge(stamp);
}

void PeopleTrackerNode::lookForBodies(const sensor_msgs::ImageConstPtr& image) {
  const std::string& topic = image_subscriber_.getTopic();
  const ros::Time& stamp = image->header.stamp;
  if (!camera_info_) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod,
                             topic << ": nothing on " << info_subscriber_.getTopic() << " yet; left out");
    return;
  }
  const auto base = planar(params_.odom_frame, params_.base_frame, stamp);
  const auto map = base ? localization(stamp) : std::nullopt;
  if (!map || !ready(topic)) return;
  try {
    const auto camera = transforms_.lookupTransform(params_.base_frame, image->header.frame_id, stamp);
    // One that came after a newer scan is still used, see TrackerParams::max_delay.
    if (!perception_.takeDepth(fromMessage(*image), fromMessage(*camera_info_), isometry(camera.transform),
                               {*base, *map}, stamp.toSec())) {
      ROS_WARN_STREAM_THROTTLE(
          kWarningPeriod, topic << ": stamp " << stamp << " is long before that of the last scan; left out");
    }
  } catch (const DepthInputError& error) {
    ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, topic << ": " << error.what() << "; left out");
  } catch (const tf2::TransformException& error) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "tf: no pose of '" << image->header.frame_id << "' in '"
                                                                << params_.base_frame
                                                                << "': " << error.what());
  }
}

void PeopleTrackerNode::predictAlone() {
  watchClock();
  if (last_scan_.isZero() || (last_now_ - last_scan_).toSec() < params_.sensor_timeout) return;
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, scan_subscriber_.getTopic()
                                               << ": no usable scan for " << (last_now_ - last_scan_).toSec()
                                               << " s; people are only predicted");
  // However old: people who are only predicted are soon forgotten, and until then must not be left standing.
  const auto map = planar(params_.map_frame, params_.odom_frame, ros::Time());
  if (!map || !due(last_now_, params_.rate, next_publication_)) return;
  perception_.advance(last_now_.toSec());
  publish(last_now_, *map);
}

void PeopleTrackerNode::publish(const ros::Time& stamp, const sarn::Pose2D& map_from_odom) {
  const std::vector<PersonTrack> people = perception_.tracker().people();
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = params_.map_frame;
  people_publisher_.publish(toPeople(people, map_from_odom, header));
  header.frame_id = params_.odom_frame;
  tracked_publisher_.publish(toTracked(people, header));
  if (marker_publisher_.getNumSubscribers() > 0) marker_publisher_.publish(trackMarkers(people, header));
}

}  // namespace sarn_perception
