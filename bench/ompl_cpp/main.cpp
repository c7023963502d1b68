// Plans one task with one planner of OMPL and prints JSON: ompl_paths PLANNER CHECK SECONDS SEED TARGET < problem
//
// PLANNER is RRTConnect, InformedRRTstar or BITstar; CHECK is `whole` (exact, see arm.hpp) or the distance between
// checked states (rad). A run ends when its path is no longer than TARGET (rad), or after SECONDS.
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "arm.hpp"

namespace ob = ompl::base;
namespace og = ompl::geometric;

Arm read(std::istream &in) {
    Arm arm;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string what;
        words >> what;
        if (what == "links") words >> arm.lengths[0] >> arm.lengths[1];
        if (what == "joint1") words >> arm.low[0] >> arm.high[0];
        if (what == "joint2") words >> arm.low[1] >> arm.high[1];
        double a, b, c;
        if (what == "circle" && words >> a >> b >> c) arm.circles.push_back({{a, b}, c, c * c});
        if (what == "start" && words >> a >> b) arm.starts.emplace_back(a, b);
        if (what == "goal" && words >> a >> b) arm.goals.emplace_back(a, b);
        if (what != "polygon") continue;
        std::vector<Point> corners;
        while (words >> a >> b) corners.push_back({a, b});
        Polygon polygon{{{0, 0}, 0, 0}, {}};
        Circle &around = polygon.around;
        for (Point p : corners) around.center = {around.center.x + p.x / corners.size(), around.center.y + p.y / corners.size()};
        for (size_t i = 0; i < corners.size(); ++i) {
            const Point from = corners[i], to = corners[(i + 1) % corners.size()], side = to - from;
            const double length = std::sqrt(dot(side, side));
            polygon.edges.push_back({from, to, {side.x / length, side.y / length}, length});
            const Point out = from - around.center;
            around.squared = std::max(around.squared, dot(out, out));
        }
        around.radius = std::sqrt(around.squared);
        arm.polygons.push_back(polygon);
    }
    return arm;
}

const double *values(const ob::State *state) { return state->as<ob::RealVectorStateSpace::StateType>()->values; }

class States : public ob::StateValidityChecker {
   public:
    States(const ob::SpaceInformationPtr &information, const Arm &arm) : StateValidityChecker(information), arm_(arm) {}
    bool isValid(const ob::State *state) const override {
        const double *q = values(state);
        return si_->satisfiesBounds(state) && arm_.free(q[0], q[1]);
    }

   private:
    const Arm &arm_;
};

class Whole : public ob::MotionValidator {
   public:
    Whole(const ob::SpaceInformationPtr &information, const Arm &arm) : MotionValidator(information), arm_(arm) {}
    bool checkMotion(const ob::State *a, const ob::State *b) const override {
        return si_->isValid(b) && arm_.freeBetween(values(a), values(b));
    }
    bool checkMotion(const ob::State *a, const ob::State *b, std::pair<ob::State *, double> &last) const override {
        if (checkMotion(a, b)) return true;
        last.second = 0;
        if (last.first != nullptr) si_->copyState(last.first, a);
        return false;
    }

   private:
    const Arm &arm_;
};

ob::PlannerPtr planner(const std::string &name, const ob::SpaceInformationPtr &information) {
    if (name == "RRTConnect") return std::make_shared<og::RRTConnect>(information);
    if (name == "InformedRRTstar") return std::make_shared<og::InformedRRTstar>(information);
    return std::make_shared<og::BITstar>(information);
}

int main(int count, char **arguments) {
    if (count == 2 && std::string(arguments[1]) == "version") return std::puts(OMPL_WAS) < 0;
    if (count != 6) return 2;
    const std::string name = arguments[1], check = arguments[2];
    const double seconds = std::stod(arguments[3]), target = std::stod(arguments[5]);
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    ompl::RNG::setSeed(std::stoul(arguments[4]));
    const Arm arm = read(std::cin);

    auto space = std::make_shared<ob::RealVectorStateSpace>(2);
    ob::RealVectorBounds bounds(2);
    for (int j = 0; j < 2; ++j) {
        bounds.setLow(j, arm.low[j]);
        bounds.setHigh(j, arm.high[j]);
    }
    space->setBounds(bounds);
    og::SimpleSetup setup(space);
    auto information = setup.getSpaceInformation();
    setup.setStateValidityChecker(std::make_shared<States>(information, arm));
    if (check == "whole")
        information->setMotionValidator(std::make_shared<Whole>(information, arm));
    else
        information->setStateValidityCheckingResolution(std::stod(check) / space->getMaximumExtent());
    auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(information);
    objective->setCostThreshold(ob::Cost(target));
    setup.setOptimizationObjective(objective);
    auto goals = std::make_shared<ob::GoalStates>(information);
    ob::ScopedState<> state(space);
    for (auto [q1, q2] : arm.starts) {
        state[0] = q1, state[1] = q2;
        setup.addStartState(state);
    }
    for (auto [q1, q2] : arm.goals) {
        state[0] = q1, state[1] = q2;
        goals->addState(state);
    }
    setup.setGoal(goals);
    setup.setPlanner(planner(name, information));
    setup.setup();

    const auto begun = std::chrono::steady_clock::now();
    const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(); };
    std::unique_ptr<og::PathGeometric> best;
    double first = 0;
    // RRTConnect does not go on by itself: it is begun again, each path simplified, the shortest kept.
    do {
        setup.clear();
        setup.solve(seconds - spent());
        if (!setup.haveExactSolutionPath()) break;
        if (name == "RRTConnect") setup.simplifySolution();
        if (!best || setup.getSolutionPath().length() < best->length())
            best = std::make_unique<og::PathGeometric>(setup.getSolutionPath());
        if (first == 0) first = spent();
    } while (name == "RRTConnect" && best->length() > target && spent() < seconds);

    std::printf("{\"seconds\": %.9g, \"first\": %.9g, \"path\": [", spent(), first);
    for (size_t i = 0; best && i < best->getStateCount(); ++i) {
        const double *q = values(best->getState(i));
        std::printf("%s[%.17g, %.17g]", i == 0 ? "" : ", ", q[0], q[1]);
    }
    std::puts("]}");
}
