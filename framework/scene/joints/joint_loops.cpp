// Mobility of loops of joints. The joints of a scene form a graph whose nodes are the bodies that move and one node for
// all that does not; a spanning tree leaves one loop per further joint. The mobility of a loop is the number of
// velocities that its joints leave free, from the rank of their constraints in the start pose, without motions of the
// loop as a whole.
#include <Eigen/SVD>
#include <algorithm>
#include <map>
#include <numeric>

#include "framework/scene/joints/joint_parts.h"

namespace presa {
namespace {

enum LoopCode { kLockedLoop = 233 };

using Row = Eigen::Matrix<double, 1, 6>;
constexpr double kRank = 1e-6;  // relative singular value that counts as zero

struct Edge {
  std::size_t joint, a, b;  // nodes
};

/// The locked directions of a joint, as rows on the velocity of `body` against `to`, at point p_W.
std::vector<Row> lockedRows(const Joint& joint, const Pose& X_WB) {
  const Vec3 p = X_WB * joint.p_BJ;
  std::vector<Row> rows;
  const auto push = [&](const Vec3& along) {
    Row row;
    row << along.transpose(), p.cross(along).transpose();
    rows.push_back(row);
  };
  const auto turn = [&](const Vec3& about) {
    Row row;
    row << 0, 0, 0, about.transpose();
    rows.push_back(row);
  };
  const auto square = [](const Vec3& d, const auto& use) {
    use(d.unitOrthogonal());
    use(d.cross(d.unitOrthogonal()));
  };
  const auto all = [](const auto& use) {
    for (int i = 0; i < 3; ++i) use(Vec3(Vec3::Unit(i)));
  };
  std::vector<Vec3> axes;
  for (const JointAxis& axis : joint.axes) axes.push_back(X_WB.q * axis.dhat_B);
  switch (joint.type) {
    case JointType::kFixed:
      all(push);
      all(turn);
      break;
    case JointType::kHinge:
      all(push);
      square(axes[0], turn);
      break;
    case JointType::kSlider:
      square(axes[0], push);
      all(turn);
      break;
    case JointType::kBall:
      all(push);
      break;
    case JointType::kUniversal:
      all(push);
      turn(axes[0].cross(axes[1]));
      break;
    case JointType::kPrismaticRotary:
      square(axes[0], push);
      square(axes[1], turn);
      break;
  }
  return rows;
}

class Loops {
 public:
  Loops(const Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {
    parent_.resize(ground() + 1);
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  void check() {
    for (std::size_t j = 0; j < scene_.joints.size(); ++j) {
      const Joint& joint = scene_.joints[j];
      const Edge edge{j, nodeOf(joint.body), nodeOf(joint.to)};
      if (rootOf(edge.a) == rootOf(edge.b)) {
        std::vector<std::size_t> loop = path(edge.a, edge.b);
        loop.push_back(j);
        judge(loop);
      } else {
        parent_[rootOf(edge.a)] = rootOf(edge.b);
        tree_[edge.a].push_back(edge);
        tree_[edge.b].push_back({j, edge.b, edge.a});
      }
    }
  }

 private:
  std::size_t ground() const { return scene_.bodies.size(); }
  std::size_t nodeOf(std::size_t body) const {
    return body == Joint::kWorld || scene_.bodies[body].fixed ? ground() : body;
  }
  std::size_t rootOf(std::size_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

  /// Joints of the tree from node a to node b.
  std::vector<std::size_t> path(std::size_t a, std::size_t b) {
    std::map<std::size_t, Edge> came;
    std::vector<std::size_t> front{a};
    while (!came.contains(b) && a != b) {
      std::vector<std::size_t> next;
      for (const std::size_t node : front) {
        for (const Edge& edge : tree_[node]) {
          if (edge.b != a && came.try_emplace(edge.b, edge).second) next.push_back(edge.b);
        }
      }
      front = std::move(next);
    }
    std::vector<std::size_t> joints;
    for (std::size_t at = b; at != a; at = came.at(at).a) joints.push_back(came.at(at).joint);
    std::ranges::reverse(joints);
    return joints;
  }

  void judge(const std::vector<std::size_t>& loop) {
    const auto moves = [&](std::size_t j) { return scene_.joints[j].type != JointType::kFixed; };
    if (!std::ranges::any_of(loop, moves) || mobilityOf(loop) > 0) return;
    std::string names;
    for (const std::size_t j : loop) names += (names.empty() ? "'" : ", '") + scene_.joints[j].name + "'";
    diagnostics_.error(kLockedLoop, scene_.joints[loop.back()].where,
                       "the joints " + names + " close a loop that cannot move",
                       "axes that run parallel or along one line, or a ball in place of a hinge; or fixed joints, if "
                       "nothing is to move");
  }

  int mobilityOf(const std::vector<std::size_t>& loop) const {
    std::map<std::size_t, Eigen::Index> columns;
    std::vector<Row> rows;
    std::vector<std::size_t> of;
    bool grounded = false;
    double reach = 1e-9;  // of the loop, so that turns weigh as much as moves [m]
    const Vec3 centre = scene_.bodies[scene_.joints[loop[0]].body].X_WB * scene_.joints[loop[0]].p_BJ;
    for (const std::size_t j : loop) {
      const Joint& joint = scene_.joints[j];
      for (const std::size_t node : {nodeOf(joint.body), nodeOf(joint.to)}) {
        grounded = grounded || node == ground();
        if (node != ground()) columns.try_emplace(node, static_cast<Eigen::Index>(6 * columns.size()));
      }
      Pose X_WB = scene_.bodies[joint.body].X_WB;
      X_WB.p -= centre;
      reach = std::max(reach, (X_WB * joint.p_BJ).norm());
      for (const Row& row : lockedRows(joint, X_WB)) {
        rows.push_back(row);
        of.push_back(j);
      }
    }
    Eigen::MatrixXd J =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(6 * columns.size()));
    for (std::size_t r = 0; r < rows.size(); ++r) {
      Row row = rows[r];
      row.tail<3>() /= reach;
      if (row.head<3>().isZero()) row *= reach;
      const Joint& joint = scene_.joints[of[r]];
      const auto at = static_cast<Eigen::Index>(r);
      if (const auto found = columns.find(nodeOf(joint.body)); found != columns.end())
        J.block<1, 6>(at, found->second) = row;
      if (const auto found = columns.find(nodeOf(joint.to)); found != columns.end())
        J.block<1, 6>(at, found->second) = -row;
    }
    const Eigen::VectorXd sigma = J.jacobiSvd().singularValues();
    int rank = 0;
    for (const double s : sigma) rank += s > kRank * sigma[0] ? 1 : 0;
    return static_cast<int>(6 * columns.size()) - rank - (grounded ? 0 : 6);
  }

  const Scene& scene_;
  Diagnostics& diagnostics_;
  std::vector<std::size_t> parent_;
  std::map<std::size_t, std::vector<Edge>> tree_;
};

}  // namespace

void checkJointLoops(const Scene& scene, Diagnostics& diagnostics) { Loops(scene, diagnostics).check(); }

}  // namespace presa
