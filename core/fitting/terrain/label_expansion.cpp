#include "core/fitting/terrain/label_expansion.h"

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

#include "core/base/contract.h"

namespace foresight {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();

/// A binary problem: node i pays on_[i] when it switches (may be negative), and an edge pays its
/// weight when `from` stays and `to` switches.
struct SwitchProblem {
  struct Arc {
    int from = 0;
    int to = 0;
    double weight = 0.0;
  };
  std::vector<double> switch_cost;
  std::vector<Arc> arcs;
};

/// Which nodes switch so that the sum is least.
std::vector<bool> LeastCut(const SwitchProblem& problem) {
  std::vector<bool> switched(problem.switch_cost.size());
  if (problem.arcs.empty()) {  // GCGraph asserts on a graph without edges
    for (std::size_t i = 0; i < switched.size(); ++i) switched[i] = problem.switch_cost[i] < 0.0;
    return switched;
  }
  cv::detail::GCGraph<double> graph(static_cast<unsigned>(switched.size()),
                                    static_cast<unsigned>(2 * problem.arcs.size()));
  for (const double cost : problem.switch_cost)
    // The sink side switches: the edge from the source is cut there.
    graph.addTermWeights(graph.addVtx(), std::max(0.0, cost), std::max(0.0, -cost));
  for (const auto& arc : problem.arcs) graph.addEdges(arc.from, arc.to, arc.weight, 0.0);
  graph.maxFlow();
  for (std::size_t i = 0; i < switched.size(); ++i)
    switched[i] = !graph.inSourceSegment(static_cast<int>(i));
  return switched;
}

/// Cost of the label that each node bears.
std::vector<double> BorneCosts(const LabelProblem& problem, std::span<const int> labels) {
  std::vector<double> costs(labels.size(), kForbidden);
  for (std::size_t label = 0; label < problem.choices.size(); ++label)
    for (const auto& choice : problem.choices[label])
      if (labels[static_cast<std::size_t>(choice.node)] == static_cast<int>(label))
        costs[static_cast<std::size_t>(choice.node)] = choice.cost;
  return costs;
}

std::vector<double> EdgeWeights(const LabelProblem& problem) {
  std::vector<double> weights(static_cast<std::size_t>(problem.nodes), 0.0);
  for (const auto& edge : problem.edges) {
    weights[static_cast<std::size_t>(edge.a)] += edge.weight;
    weights[static_cast<std::size_t>(edge.b)] += edge.weight;
  }
  return weights;
}

/// Adds what an edge between two labels pays, given whether each end takes the new one.
void AddEdge(const LabelProblem::Edge& edge, std::span<const int> labels,
             const std::vector<int>& variable, int label, SwitchProblem& cut) {
  const int label_a = labels[static_cast<std::size_t>(edge.a)];
  const int label_b = labels[static_cast<std::size_t>(edge.b)];
  const int a = variable[static_cast<std::size_t>(edge.a)];
  const int b = variable[static_cast<std::size_t>(edge.b)];
  const double neither = label_a != label_b ? edge.weight : 0.0;
  const double only_a = label_b != label ? edge.weight : 0.0;
  const double only_b = label_a != label ? edge.weight : 0.0;
  if (a >= 0 && b >= 0) {
    // neither + (only_a - neither) a - only_a b + (only_a + only_b - neither) (1 - a) b
    cut.switch_cost[static_cast<std::size_t>(a)] += only_a - neither;
    cut.switch_cost[static_cast<std::size_t>(b)] -= only_a;
    cut.arcs.push_back({a, b, only_a + only_b - neither});
  } else if (a >= 0) {
    cut.switch_cost[static_cast<std::size_t>(a)] += only_a - neither;
  } else if (b >= 0) {
    cut.switch_cost[static_cast<std::size_t>(b)] += only_b - neither;
  }
}

bool Expand(const LabelProblem& problem, int label, const std::vector<double>& weights,
            std::vector<int>& labels, std::vector<double>& costs) {
  std::vector<int> variable(static_cast<std::size_t>(problem.nodes), -1);
  std::vector<LabelProblem::Choice> movable;
  SwitchProblem cut;
  for (const auto& choice : problem.choices[static_cast<std::size_t>(label)]) {
    const auto node = static_cast<std::size_t>(choice.node);
    if (labels[node] == label || choice.cost - costs[node] > weights[node]) continue;
    variable[node] = static_cast<int>(movable.size());
    movable.push_back(choice);
    cut.switch_cost.push_back(choice.cost - costs[node]);
  }
  if (movable.empty()) return false;
  for (const auto& edge : problem.edges)
    if (variable[static_cast<std::size_t>(edge.a)] >= 0 ||
        variable[static_cast<std::size_t>(edge.b)] >= 0)
      AddEdge(edge, labels, variable, label, cut);
  std::erase_if(cut.arcs, [](const auto& arc) { return !(arc.weight > 0.0); });
  const std::vector<bool> switched = LeastCut(cut);
  bool changed = false;
  for (std::size_t i = 0; i < movable.size(); ++i) {
    if (!switched[i]) continue;
    const auto node = static_cast<std::size_t>(movable[i].node);
    labels[node] = label;
    costs[node] = movable[i].cost;
    changed = true;
  }
  return changed;
}

}  // namespace

double LabelEnergy(const LabelProblem& problem, std::span<const int> labels) {
  double energy = 0.0;
  for (const double cost : BorneCosts(problem, labels)) energy += cost;
  for (const auto& edge : problem.edges)
    if (labels[static_cast<std::size_t>(edge.a)] != labels[static_cast<std::size_t>(edge.b)])
      energy += edge.weight;
  return energy;
}

bool ExpandLabel(const LabelProblem& problem, int label, std::vector<int>& labels) {
  FORESIGHT_EXPECTS(std::ssize(labels) == problem.nodes, "a label for each node");
  std::vector<double> costs = BorneCosts(problem, labels);
  return Expand(problem, label, EdgeWeights(problem), labels, costs);
}

void ExpandLabels(const LabelProblem& problem, int sweeps, std::vector<int>& labels) {
  FORESIGHT_EXPECTS(std::ssize(labels) == problem.nodes, "a label for each node");
  std::vector<double> costs = BorneCosts(problem, labels);
  const std::vector<double> weights = EdgeWeights(problem);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool changed = false;
    for (int label = 0; label < static_cast<int>(problem.choices.size()); ++label)
      changed |= Expand(problem, label, weights, labels, costs);
    if (!changed) return;
  }
}

}  // namespace foresight
