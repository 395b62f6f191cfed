#include "state/model_archive.hpp"

#include <algorithm>
#include <dart/dynamics/DegreeOfFreedom.hpp>
#include <dart/dynamics/Marker.hpp>
#include <dart/dynamics/SoftBodyNode.hpp>

#include "base/checks.hpp"
#include "collision/detector.hpp"
#include "contact/fast_solver.hpp"
#include "state/model_joints.hpp"
#include "state/model_shapes.hpp"

namespace pydart2 {

namespace {

using namespace dart::dynamics;

double not_negative(double value)
{
  check::not_negative(value, "a number of a soft body");
  return value;
}

void visit_soft_body(Archive& archive, SoftBodyNode& body)
{
  archive.count(body.getNumPointMasses());
  archive.number([&] { return body.getVertexSpringStiffness(); }, [&](double k) { body.setVertexSpringStiffness(not_negative(k)); });
  archive.number([&] { return body.getEdgeSpringStiffness(); }, [&](double k) { body.setEdgeSpringStiffness(not_negative(k)); });
  archive.number([&] { return body.getDampingCoefficient(); }, [&](double d) { body.setDampingCoefficient(not_negative(d)); });
}

/// Mass, COM and the moment of inertia about the COM (xx yy zz xy xz yz).
Eigen::Matrix<double, 10, 1> inertia_of(const BodyNode& body)
{
  const auto& inertia = body.getInertia();
  Eigen::Matrix<double, 10, 1> values;
  for (int i = 0; i < 10; ++i)
    values[i] = inertia.getParameter(static_cast<Inertia::Param>(i));
  return values;
}

void set_inertia(BodyNode& body, const Eigen::VectorXd& v)
{
  check::finite(VectorIn{v.data(), v.size()}, "the inertia of a body");
  for (const int i : {0, 4, 5, 6}) // mass, and the moments about the axes
    check::not_negative(v[i], "the inertia of a body");
  body.setInertia(Inertia(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9]));
}

void visit_body(Archive& archive, BodyNode& body)
{
  archive.same(body.getName());
  archive.vector([&] { return inertia_of(body); }, [&](const auto& values) { set_inertia(body, values); });
  archive.number([&] { return double(body.getGravityMode()); }, [&](double on) { body.setGravityMode(on != 0.0); });
  archive.number([&] { return double(body.isCollidable()); }, [&](double on) { body.setCollidable(on != 0.0); });
  for (auto* node : body.getShapeNodes())
    visit_shape(archive, *node);
  if (auto* soft = body.asSoftBodyNode())
    visit_soft_body(archive, *soft);
}

} // namespace

void visit_skeleton(Archive& archive, SkeletonRecord& item)
{
  auto& skeleton = *item.skeleton;
  archive.same(
      std::to_string(skeleton.getNumBodyNodes()) + " bodies, " + std::to_string(skeleton.getNumDofs()) + " dofs, "
      + std::to_string(skeleton.getNumMarkers()) + " markers");
  for (const std::size_t number : {skeleton.getNumBodyNodes(), skeleton.getNumDofs(), skeleton.getNumMarkers()})
    if (archive.count(number) != number) // the numbers are of another skeleton than the texts
      Archive::refuse();
  archive.text([&] { return skeleton.getName(); }, [&](const auto& name) { skeleton.setName(name); });
  archive.number(
      [&] { return double(skeleton.isMobile() || item.island != 0); }, [&](double on) { skeleton.setMobile(on != 0.0); });
  archive.number(
      [&] { return double(skeleton.getSelfCollisionCheck()); },
      [&](double on) { skeleton.setSelfCollisionCheck(on != 0.0); });
  archive.number(
      [&] { return double(skeleton.getAdjacentBodyCheck()); },
      [&](double on) { skeleton.setAdjacentBodyCheck(on != 0.0); });
  for (auto* body : skeleton.getBodyNodes())
    visit_body(archive, *body);
  visit_joints(archive, skeleton);
  for (std::size_t i = 0; i < skeleton.getNumMarkers(); ++i) {
    auto& marker = *skeleton.getMarker(i);
    archive.same(marker.getName());
    archive.vector(
        [&] { return marker.getLocalPosition(); }, [&](const auto& p) { marker.setLocalPosition(Eigen::Vector3d(p)); });
  }
}

namespace {

/// A body as two numbers: index of its skeleton in the world, its own index.
BodyNode* visit_reference(Archive& archive, const WorldRecord& world, const BodyNode* body)
{
  const auto index = [&] { return static_cast<std::size_t>(world.index_of(body->getSkeleton())); };
  const auto skeleton = archive.count(body == nullptr ? 0 : index());
  const auto own = archive.count(body == nullptr ? 0 : body->getIndexInSkeleton());
  if (skeleton >= world.skeletons.size() || own >= world.skeletons[skeleton]->skeleton->getNumBodyNodes())
    Archive::refuse();
  return world.skeletons[skeleton]->skeleton->getBodyNode(own);
}

/// Of things that take a number each, at least.
std::size_t bounded_count(Archive& archive, std::size_t now)
{
  const auto count = archive.count(now);
  if (archive.is_in() && count > archive.numbers.size())
    Archive::refuse();
  return count;
}

void visit_ignored_pairs(Archive& archive, WorldRecord& world)
{
  world.ignored_pairs.resize(bounded_count(archive, world.ignored_pairs.size()));
  for (auto& [body1, body2] : world.ignored_pairs) {
    body1 = visit_reference(archive, world, body1);
    body2 = visit_reference(archive, world, body2);
  }
}

void visit_collision_bits(Archive& archive, WorldRecord& world)
{
  auto& bits = world.collision_bits;
  if (archive.is_in())
    bits.clear();
  if (archive.part("collision bits", !bits.empty()))
    for (const auto& item : world.skeletons)
      for (const auto* body : item->skeleton->getBodyNodes()) {
        const auto found = bits.find(body);
        auto of = found == bits.end() ? engine::CollisionBits() : found->second;
        for (auto* value : {&of.group, &of.mask})
          archive.number(
              [&] { return double(*value); },
              [&](double number) {
                if (!(number >= 0.0 && number <= 4294967295.0))
                  Archive::refuse();
                *value = static_cast<std::uint32_t>(number);
              });
        if (archive.is_in() && !of.usual())
          bits[body] = of;
      }
}

/// What is as in a new world is not saved.
void visit_settings(Archive& archive, WorldRecord& record)
{
  auto& solver = fast_solver(*record.world);
  auto& most = solver.getCollisionOption().maxNumContacts;
  const FastConstraintSolver fresh;
  const bool changed = most != unlimited_contacts || solver.memory_limit() != fresh.memory_limit();
  if (!archive.part("settings", changed))
    return;
  archive.number(
      [&] { return static_cast<double>(most); }, [&](double number) {
        if (!(number >= 1.0 && number <= static_cast<double>(unlimited_contacts)))
          Archive::refuse();
        most = static_cast<std::size_t>(number);
      });
  archive.number([&] { return solver.memory_limit(); }, [&](double bytes) {
    check::positive(bytes, "the contact memory limit");
    solver.set_memory_limit(bytes);
  });
}

void visit_error_reduction(Archive& archive, FastConstraintSolver& solver)
{
  const double engine = FastConstraintSolver::engine_error_reduction();
  if (archive.part("error reduction", solver.error_reduction() != engine))
    archive.number([&] { return solver.error_reduction(); }, [&](double share) {
      if (!(share >= 0.0 && share <= 1.0))
        Archive::refuse();
      solver.set_error_reduction(share);
    });
}

void visit_manner_of_steps(Archive& archive, WorldRecord& record)
{
  if (!archive.part("manner of steps", record.deterministic || record.nan_at_blow_up))
    return;
  archive.number([&] { return double(record.deterministic); }, [&](double on) { record.deterministic = on != 0.0; });
  archive.number([&] { return double(record.nan_at_blow_up); }, [&](double on) { record.nan_at_blow_up = on != 0.0; });
}

void visit_sleep(Archive& archive, Sleep& sleep)
{
  sleep.enabled = archive.part("sleep", sleep.enabled);
  if (!sleep.enabled)
    return;
  for (double* number : {&sleep.linear, &sleep.angular, &sleep.seconds})
    archive.number([&] { return *number; }, [&](double value) {
      check::positive(value, "a setting of sleep");
      *number = value;
    });
}

void visit_kinds(Archive& archive, std::vector<ConstraintRecord>& constraints)
{
  for (auto& record : constraints) {
    const auto kind = archive.count(static_cast<std::size_t>(record.kind));
    if (kind >= ConstraintRecord::num_kinds)
      Archive::refuse();
    record.kind = static_cast<ConstraintRecord::Kind>(kind);
    if (archive.count(record.body2 == nullptr) != 0)
      record.body2 = nullptr;
  }
}

void visit_distances(Archive& archive, std::vector<ConstraintRecord>& constraints)
{
  for (auto& record : constraints) {
    archive.vector(
        [&] { return record.point2; },
        [&](const Eigen::VectorXd& point) {
          check::finite(Eigen::Vector3d(point), "the second point of a constraint");
          record.point2 = point;
        });
    archive.number(
        [&] { return record.length; },
        [&](double length) {
          check::not_negative(length, "the length of a constraint");
          record.length = length;
        });
    record.rope = archive.count(record.rope) != 0;
  }
}

/// What became of constraints after they were made, and the axes of revolute ones.
void visit_settings(Archive& archive, std::vector<ConstraintRecord>& constraints)
{
  for (auto& record : constraints) {
    archive.vector(
        [&] { return record.axis; },
        [&](const Eigen::VectorXd& axis) {
          check::finite(Eigen::Vector3d(axis), "the axis of a constraint");
          record.axis = axis;
        });
    record.enabled = archive.count(record.enabled) != 0;
    if (archive.count(record.target.has_value()) != 0) {
      archive.vector(
          [&]() -> Eigen::VectorXd { return Eigen::Map<const Eigen::VectorXd>(record.target->data(), 16); },
          [&](const Eigen::VectorXd& numbers) {
            record.target.emplace();
            record.target->matrix() = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
            check::rigid(record.target->matrix(), "the target of a constraint");
          });
    }
  }
}

void visit_constraints(Archive& archive, WorldRecord& world)
{
  auto& solver = *world.world->getConstraintSolver();
  const bool plain = std::all_of(world.constraints.begin(), world.constraints.end(), [](const auto& record) {
    return record.kind == ConstraintRecord::Kind::ball && record.body2 != nullptr;
  });
  const auto count = bounded_count(archive, world.constraints.size());
  if (archive.is_in()) {
    solver.removeAllConstraints();
    world.constraints.assign(count, ConstraintRecord{});
  }
  for (auto& record : world.constraints) {
    record.body1 = visit_reference(archive, world, record.body1);
    auto* const body2 = visit_reference(archive, world, record.body2 ? record.body2 : record.body1);
    if (archive.is_in()) {
      record.id = ++world.last_constraint;
      record.body2 = body2;
      record.skeleton1 = record.body1->getSkeleton();
      record.skeleton2 = body2->getSkeleton();
      record.positions1.setZero(static_cast<long>(record.skeleton1->getNumDofs()));
      record.positions2.setZero(static_cast<long>(record.skeleton2->getNumDofs()));
    }
    const Eigen::VectorXd none = record.positions1; // of the world itself: those of the body that it holds
    archive.vector([&] { return record.point; }, [&](const auto& point) { record.point = point; });
    archive.vector([&] { return record.positions1; }, [&](const auto& q) { record.positions1 = q; });
    archive.vector(
        [&] { return record.skeleton2 ? record.positions2 : none; }, [&](const auto& q) { record.positions2 = q; });
  }
  if (archive.part("constraint kinds", !plain)) // earlier versions had ball joints between two bodies alone
    visit_kinds(archive, world.constraints);
  const bool as_made = std::all_of(world.constraints.begin(), world.constraints.end(), [](const auto& record) {
    return record.enabled && !record.target && record.kind != ConstraintRecord::Kind::revolute;
  });
  if (archive.part("constraint settings", !as_made))
    visit_settings(archive, world.constraints);
  const bool has_distance = std::any_of(world.constraints.begin(), world.constraints.end(), [](const auto& record) {
    return record.kind == ConstraintRecord::Kind::distance;
  });
  if (archive.part("distances", has_distance))
    visit_distances(archive, world.constraints);
  if (archive.is_in())
    for (auto& record : world.constraints) {
      if (record.body2 == nullptr)
        record.skeleton2 = nullptr;
      renew(record, solver);
    }
}

void visit_armature(Archive& archive, WorldRecord& world)
{
  bool any = false;
  for (const auto& item : world.skeletons)
    any |= !item->armature.empty();
  if (!archive.part("armature", any))
    return;
  for (const auto& item : world.skeletons)
    for (auto* dof : item->skeleton->getDofs()) {
      const auto found = item->armature.find(dof);
      archive.number(
          [&] { return found == item->armature.end() ? 0.0 : found->second; },
          [&](double inertia) {
            if (!(inertia > 0.0))
              Archive::refuse();
            item->armature[dof] = inertia;
          });
    }
}

} // namespace

void visit_model(Archive& archive, WorldRecord& record, bool with_skeletons)
{
  auto& world = *record.world;
  archive.same(std::to_string(record.skeletons.size()) + " skeletons");
  archive.number([&] { return world.getTimeStep(); }, [&](double step) {
    check::positive(step, "the time step");
    world.setTimeStep(step);
  });
  archive.vector([&] { return world.getGravity(); }, [&](const auto& g) {
    check::finite(VectorIn{g.data(), g.size()}, "gravity");
    world.setGravity(Eigen::Vector3d(g));
  });
  for (const auto& item : record.skeletons)
    if (with_skeletons) {
      visit_skeleton(archive, *item);
      item->limits_checked &= !archive.is_in();
    }
  visit_detector(archive, *world.getConstraintSolver());
  auto& solver = fast_solver(world);
  archive.text(
      [&] { return std::string(name_of(solver.solver())); },
      [&](const auto& name) { solver.set_solver(solver_named(name)); });
  archive.number(
      [&] { return double(solver.contact_reduction()); }, [&](double on) { solver.set_contact_reduction(on != 0.0); });
  archive.number([&] { return double(solver.warm_start()); }, [&](double on) { solver.set_warm_start(on != 0.0); });
  if (solver.solver() == Solver::iterative)
    archive.vector(
        [&] { return numbers_of(solver.iterative().options); },
        [&](const auto& numbers) { solver.iterative().options = options_of(numbers); });
  visit_ignored_pairs(archive, record);
  visit_constraints(archive, record);
  visit_armature(archive, record);
  visit_settings(archive, record);
  visit_manner_of_steps(archive, record);
  visit_error_reduction(archive, fast_solver(*record.world));
  const bool fast = archive.part("fast dynamics", record.dynamics == Dynamics::fast);
  record.dynamics = fast ? Dynamics::fast : Dynamics::engine;
  if (!archive.part("integrator", record.integrator != Integrator::engine))
    record.integrator = Integrator::engine;
  else
    archive.text(
        [&] { return std::string(name_of(record.integrator)); },
        [&](const auto& name) { record.integrator = integrator_named(name); });
  visit_collision_bits(archive, record);
  if (archive.is_in())
    apply_collision_filter(record);
  visit_sleep(archive, record.sleep);
  auto& threads = solver.iterative().options.threads;
  if (archive.part("solver threads", threads != 1))
    archive.number([&] { return double(threads); }, [&](double count) { threads = count >= 1.0 && count <= 256.0 ? static_cast<int>(count) : 1; });
}

namespace {

/// Whether the numbers and texts are those of before, which they become.
bool same(Archive& now, KnownModel::Part& before)
{
  const bool equal = now.texts == before.texts && now.numbers.size() == before.numbers.size()
                     && std::memcmp(now.numbers.data(), before.numbers.data(), now.numbers.size() * sizeof(double)) == 0;
  before = {std::move(now.texts), std::move(now.numbers)};
  return equal;
}

} // namespace

std::string& known_digest(WorldRecord& record)
{
  auto& known = record.known_model;
  Archive around;
  visit_model(around, record, false);
  bool equal = same(around, known.around);
  if (known.changes != record.changes) {
    Archive all;
    visit_model(all, record);
    equal &= same(all, known.all);
    known.changes = record.changes;
  }
  if (!equal)
    known.digest.clear();
  return known.digest;
}

} // namespace pydart2
