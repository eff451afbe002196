#include "core/fitting/terrain/label_expansion.h"

#include <gtest/gtest.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cmath>

#include "core/base/random.h"

namespace foresight {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using Vertex = boost::property<
    boost::vertex_index_t, long,
    boost::property<
        boost::vertex_color_t, boost::default_color_type,
        boost::property<boost::vertex_distance_t, long,
                        boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>>;
using Arc = boost::property<
    boost::edge_capacity_t, double,
    boost::property<boost::edge_residual_capacity_t, double,
                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>;
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Vertex, Arc>;

void AddArc(std::size_t from, std::size_t to, double capacity, Graph& graph) {
  const auto forward = boost::add_edge(from, to, graph).first;
  const auto backward = boost::add_edge(to, from, graph).first;
  boost::put(boost::edge_capacity, graph, forward, capacity);
  boost::put(boost::edge_capacity, graph, backward, 0.0);
  boost::put(boost::edge_reverse, graph, forward, backward);
  boost::put(boost::edge_reverse, graph, backward, forward);
}

/// The expansion as its authors draw it: all nodes in the graph, an extra node on each edge between
/// different labels, nothing pruned. Returns the least energy.
double ExpandedEnergyByBoost(const LabelProblem& problem, int label,
                             const std::vector<int>& labels) {
  constexpr double kInfinite = 1e6;
  const auto nodes = static_cast<std::size_t>(problem.nodes);
  std::vector<double> keep(nodes, 0.0), take(nodes, kInfinite);
  for (std::size_t k = 0; k < problem.choices.size(); ++k)
    for (const auto& choice : problem.choices[k]) {
      const auto node = static_cast<std::size_t>(choice.node);
      if (labels[node] == static_cast<int>(k)) keep[node] = choice.cost;
      if (label == static_cast<int>(k)) take[node] = choice.cost;
    }
  for (std::size_t i = 0; i < nodes; ++i)
    if (labels[i] == label) keep[i] = kInfinite;
  Graph graph(nodes + problem.edges.size() + 2);
  const std::size_t source = nodes + problem.edges.size(), sink = source + 1;
  // The source's side takes the label: its edge to the sink is cut.
  for (std::size_t i = 0; i < nodes; ++i) {
    AddArc(source, i, keep[i], graph);
    AddArc(i, sink, take[i], graph);
  }
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const auto a = static_cast<std::size_t>(problem.edges[e].a);
    const auto b = static_cast<std::size_t>(problem.edges[e].b);
    const double weight = problem.edges[e].weight;
    if (labels[a] == labels[b]) {
      const double pays = labels[a] == label ? 0.0 : weight;
      AddArc(a, b, pays, graph);
      AddArc(b, a, pays, graph);
      continue;
    }
    const std::size_t middle = nodes + e;
    const double to_a = labels[a] == label ? 0.0 : weight;
    const double to_b = labels[b] == label ? 0.0 : weight;
    AddArc(a, middle, to_a, graph);
    AddArc(middle, a, to_a, graph);
    AddArc(b, middle, to_b, graph);
    AddArc(middle, b, to_b, graph);
    AddArc(source, middle, weight, graph);
  }
  return boost::boykov_kolmogorov_max_flow(graph, source, sink);
}

LabelProblem RandomProblem(int width, int height, int labels, Random& random) {
  LabelProblem problem;
  problem.nodes = width * height;
  problem.choices.resize(static_cast<std::size_t>(labels));
  for (int k = 0; k < labels; ++k)
    for (int i = 0; i < problem.nodes; ++i)
      // Some planes do not reach some points; none reaches all.
      if (k == 0 || random.Uniform() < 0.8)
        problem.choices[static_cast<std::size_t>(k)].push_back({i, random.Uniform(0.0, 5.0)});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * width + x;
      if (x + 1 < width) problem.edges.push_back({i, i + 1, random.Uniform(0.0, 2.0)});
      if (y + 1 < height) problem.edges.push_back({i, i + width, random.Uniform(0.0, 2.0)});
    }
  return problem;
}

/// The least energy among all moves that give `label` to some nodes.
double BestMoveByTrial(const LabelProblem& problem, int label, const std::vector<int>& labels) {
  double least = LabelEnergy(problem, labels);
  for (unsigned move = 0; move < (1U << problem.nodes); ++move) {
    std::vector<int> moved = labels;
    for (int i = 0; i < problem.nodes; ++i)
      if ((move >> i) & 1U) moved[static_cast<std::size_t>(i)] = label;
    least = std::min(least, LabelEnergy(problem, moved));
  }
  return least;
}

TEST(LabelExpansion, FindsTheBestMoveOfAllOnSmallGraphs) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const LabelProblem problem = RandomProblem(3, 3, 4, random);
    std::vector<int> labels(9, 0);
    for (const int label : {2, 1, 3, 2}) {
      const double best = BestMoveByTrial(problem, label, labels);
      ExpandLabel(problem, label, labels);
      EXPECT_NEAR(LabelEnergy(problem, labels), best, 1e-9) << "seed " << seed;
    }
  }
}

TEST(LabelExpansion, AgreesWithAnotherSolverOnALargerGraph) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    const LabelProblem problem = RandomProblem(30, 20, 5, random);
    std::vector<int> labels(600, 0);
    for (const int label : {1, 2, 3, 4, 1, 0}) {
      const double other = ExpandedEnergyByBoost(problem, label, labels);
      ExpandLabel(problem, label, labels);
      EXPECT_NEAR(LabelEnergy(problem, labels), other, 1e-6) << "seed " << seed;
    }
  }
}

TEST(LabelExpansion, NeverRaisesTheEnergy) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const LabelProblem problem = RandomProblem(12, 9, 6, random);
    std::vector<int> labels(108, 0);
    double energy = LabelEnergy(problem, labels);
    for (int step = 0; step < 18; ++step) {
      ExpandLabel(problem, step % 6, labels);
      const double after = LabelEnergy(problem, labels);
      EXPECT_LE(after, energy + 1e-9);
      energy = after;
    }
  }
}

TEST(LabelExpansion, ASweepEndsWhereNoLabelCanBeExpandedAnyMore) {
  Random random(7);
  const LabelProblem problem = RandomProblem(10, 10, 5, random);
  std::vector<int> labels(100, 0);
  ExpandLabels(problem, 20, labels);
  for (int label = 0; label < 5; ++label) EXPECT_FALSE(ExpandLabel(problem, label, labels));
}

TEST(LabelExpansion, NodesWithoutNeighborsTakeTheCheapestLabel) {
  LabelProblem problem;
  problem.nodes = 2;
  problem.choices = {{{0, 3.0}, {1, 3.0}}, {{0, 1.0}, {1, 5.0}}};
  std::vector<int> labels = {0, 0};
  ExpandLabels(problem, 1, labels);
  EXPECT_EQ(labels, (std::vector<int>{1, 0}));
}

TEST(LabelExpansion, ForbiddenLabelsCostInfinitelyMuch) {
  LabelProblem problem;
  problem.nodes = 1;
  problem.choices = {{{0, 3.0}}, {}};
  EXPECT_TRUE(std::isinf(LabelEnergy(problem, std::vector<int>{1})));
}

}  // namespace
}  // namespace foresight
