"""Terms of the balance: one thought a file, each adding its part of the residual and the tangent."""
