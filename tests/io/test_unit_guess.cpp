#include "fascicle/io/unit_guess.hpp"

#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("The unit is guessed from the diagonal, and the guess says so", "[io][unit]") {
    CHECK(guess_length_unit(0.47).unit == LengthUnit::metre);
    CHECK(guess_length_unit(0.47).sentence() ==
          "unit guessed: metres (diagonal 0.47); --units tells otherwise");
    CHECK(guess_length_unit(412.3).unit == LengthUnit::millimetre);
    CHECK(guess_length_unit(412.3).sentence() ==
          "unit guessed: millimetres (diagonal 412); --units tells otherwise");
    CHECK(guess_length_unit(4.999).unit == LengthUnit::metre);
    CHECK(guess_length_unit(5).unit == LengthUnit::millimetre);
    CHECK(guess_length_unit(5000).sure);
    CHECK_FALSE(guess_length_unit(470000).sure);
    CHECK_FALSE(guess_length_unit(0).sure);
    CHECK(guess_length_unit(470000).sentence().find("fits neither") != std::string::npos);
}

TEST_CASE("A surface that was inside out as a whole is told from one with a part inside out", "[io][unit]") {
    const TriMesh ball = test::sphere(1, 1);
    CHECK_FALSE(is_inside_out(mend(ball).report));
    CHECK(is_inside_out(mend(test::inside_out(ball)).report));
    const TriMesh far = test::sphere(1, 1, Vec3(5, 0, 0));
    CHECK_FALSE(is_inside_out(mend(test::joined(ball, test::inside_out(far))).report));
    CHECK(is_inside_out(mend(test::joined(test::inside_out(ball), test::inside_out(far))).report));
}
