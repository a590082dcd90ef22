#include "world.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace fetch {
namespace {

constexpr std::string_view kHall = "hall";
constexpr Place kPlaces[] = {
    {"dock", kHall, {0, 0}},          {"sofa", kHall, {5, 0.5}},
    {"kitchen_door", kHall, {3, 2}},  {"office_door", kHall, {7, 2}},
    {"kitchen", "kitchen", {3, 4}},   {"office", "office", {7, 4}},
    {"counter", "kitchen", {0.5, 6}}, {"table", "kitchen", {4, 7}},
    {"desk", "office", {6, 7}},       {"shelf", "office", {9.5, 6}},
};
constexpr std::size_t kFirstSpot = 6;  // things lie at this place or a later one

// The one whose `name_of` is `name`; `kind` is for the message.
template <class Range, class NameOf>
auto& find(Range& range, std::string_view name, const char* kind, NameOf name_of) {
  std::string known;
  for (auto& one : range) {
    if (name_of(one) == name) return one;
    known += (known.empty() ? "" : ", ") + std::string(name_of(one));
  }
  throw std::runtime_error("there is no " + std::string(kind) + " '" + std::string(name) +
                           "', only " + known);
}

}  // namespace

double distance(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

World::World(lockstep::Run& run)
    : position(kPlaces[0].point),
      room(kPlaces[0].room),
      at(&kPlaces[0]),
      battery(run.uniform(0.3, 0.6)),
      doors_{{{"kitchen", "kitchen_door", {3, 3}}, {"office", "office_door", {7, 3}}}},
      objects_{{{"mug"}, {"book"}, {"bottle"}}} {
  for (Door& door : doors_) door.is_open = run.random() < 0.5;
  constexpr std::size_t kSpots = std::size(kPlaces) - kFirstSpot;
  for (Object& object : objects_) object.place = &kPlaces[kFirstSpot + run.random_bits() % kSpots];
}

const Place& World::place(std::string_view name) {
  return find(kPlaces, name, "place", [](const Place& place) { return place.name; });
}

Door& World::door(std::string_view to_room) {
  return find(doors_, to_room, "door to", [](const Door& door) { return door.room; });
}

Object& World::object(std::string_view name) {
  return find(objects_, name, "object", [](const Object& object) { return object.name; });
}

const Door* World::door_of(std::string_view of_room) const {
  for (const Door& door : doors_) {
    if (door.room == of_room) return &door;
  }
  return nullptr;
}

std::vector<Waypoint> World::route_to(const Place& goal) const {
  std::vector<Waypoint> route;
  if (goal.room != room) {
    if (const Door* out = door_of(room)) route.push_back({out->point, kHall, out});
    if (const Door* in = door_of(goal.room)) route.push_back({in->point, goal.room, in});
  }
  route.push_back({goal.point, goal.room});
  return route;
}

}  // namespace fetch
