#include "loading/built_skin.hpp"

#include <cmath>

#include "base/checks.hpp"
#include "base/errors.hpp"

namespace pydart2::built {

using dart::dynamics::PointMass;
using dart::dynamics::SoftBodyNode;

namespace {

std::size_t index_in(const Skin& skin, double number, const char* what)
{
  if (number != std::floor(number) || std::abs(number) > 1e9)
    throw Error(Kind::value, std::string(what) + " are whole numbers, got " + std::to_string(number));
  return check::index(static_cast<long>(number), skin.mPointProps.size(), what);
}

} // namespace

Skin make_skin(const MatrixIn& points, const VectorIn& masses, const MatrixIn& edges, const MatrixIn& faces)
{
  check::shape(points, static_cast<std::size_t>(points.rows), 3, "points of a skin");
  check::finite(VectorIn{points.data, 3 * points.rows}, "points of a skin");
  check::size(masses.size, static_cast<std::size_t>(points.rows), "masses of a skin");
  check::shape(edges, static_cast<std::size_t>(edges.rows), 2, "edges of a skin");
  check::shape(faces, static_cast<std::size_t>(faces.rows), 3, "triangles of a skin");
  if (points.rows == 0)
    throw Error(Kind::value, "a skin needs points");
  Skin skin;
  for (long i = 0; i < points.rows; ++i) {
    check::positive(masses.data[i], "masses of a skin");
    skin.addPointMass(PointMass::Properties(Eigen::Vector3d(points.data + 3 * i), masses.data[i]));
  }
  for (long i = 0; i < edges.rows; ++i) {
    const auto a = index_in(skin, edges.data[2 * i], "edges of a skin"), b = index_in(skin, edges.data[2 * i + 1], "edges of a skin");
    skin.mPointProps[a].mConnectedPointMassIndices.push_back(b);
    skin.mPointProps[b].mConnectedPointMassIndices.push_back(a);
  }
  for (long i = 0; i < faces.rows; ++i) {
    Eigen::Vector3i face;
    for (int k = 0; k < 3; ++k)
      face[k] = static_cast<int>(index_in(skin, faces.data[3 * i + k], "triangles of a skin"));
    skin.addFace(face);
  }
  return skin;
}

void write_skin(std::ostream& out, const SoftBodyNode* body)
{
  out << ' ' << (body == nullptr ? 0 : body->getNumPointMasses());
  if (body == nullptr)
    return;
  const Skin& skin = body->getSoftBodyNodeProperties();
  for (const auto& point : skin.mPointProps) {
    out << ' ' << point.mX0.x() << ' ' << point.mX0.y() << ' ' << point.mX0.z() << ' ' << point.mMass;
    out << ' ' << point.mConnectedPointMassIndices.size();
    for (const auto neighbour : point.mConnectedPointMassIndices)
      out << ' ' << neighbour;
  }
  out << ' ' << skin.mFaces.size();
  for (const auto& face : skin.mFaces)
    out << ' ' << face[0] << ' ' << face[1] << ' ' << face[2];
}

Skin read_skin(std::istream& in)
{
  Skin skin;
  std::size_t num_points = 0, number = 0, count = 0;
  in >> num_points;
  const auto read_index = [&] {
    if (in >> number && number >= num_points)
      in.setstate(std::ios::failbit);
    return number;
  };
  for (std::size_t i = 0; i < num_points && in; ++i) {
    PointMass::Properties point;
    in >> point.mX0.x() >> point.mX0.y() >> point.mX0.z() >> point.mMass >> count;
    for (std::size_t k = 0; k < count && in; ++k)
      point.mConnectedPointMassIndices.push_back(read_index());
    if (!(point.mMass > 0.0) || !point.mX0.allFinite())
      in.setstate(std::ios::failbit);
    skin.addPointMass(point);
  }
  if (num_points > 0)
    in >> count;
  for (std::size_t i = 0; i < (num_points > 0 ? count : 0) && in; ++i) {
    Eigen::Vector3i face;
    for (int k = 0; k < 3; ++k)
      face[k] = static_cast<int>(read_index());
    skin.addFace(face);
  }
  return skin;
}

} // namespace pydart2::built
