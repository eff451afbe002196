#pragma once

#include <span>
#include <vector>

namespace foresight {

/// Labels for the nodes of a graph: each choice has its cost, and neighbours that differ pay for
/// it. E(labels) = sum of the chosen costs + sum of the weights of edges whose ends differ.
struct LabelProblem {
  struct Choice {
    int node = 0;
    double cost = 0.0;
  };
  struct Edge {
    int a = 0;
    int b = 0;
    double weight = 0.0;  ///< at least 0
  };

  int nodes = 0;
  /// For each label the nodes that may bear it, each at most once.
  std::vector<std::vector<Choice>> choices;
  std::vector<Edge> edges;
};

/// Infinite where a node bears a label that it may not.
double LabelEnergy(const LabelProblem& problem, std::span<const int> labels);

/// One alpha-expansion (Boykov, Veksler and Zabih 2001): every node keeps its label or takes
/// `label`, so that the energy is the least that this can give; it never rises. Nodes whose cost
/// would grow by more than all their edges weigh are left out of the cut, which changes nothing.
/// Returns whether any label changed.
bool ExpandLabel(const LabelProblem& problem, int label, std::vector<int>& labels);

/// Expands every label in turn, `sweeps` times or until nothing changes. Each node of `labels`
/// bears a label that it may.
void ExpandLabels(const LabelProblem& problem, int sweeps, std::vector<int>& labels);

}  // namespace foresight
