# The constants of docs/theory/certified_ccd.md (5), (6), (7), second order included. Standard model: every rounding is a factor 1 + e, |e| <= u = 2^-53, of its
# exact value or of its result, whichever serves (both hold); underflow is treated on that page. Sums over coordinates and nodes are triangle inequalities, so it suffices to
# bound the factor of each term: of |y| <= Y, |q| <= Q, |m| <= R with Y + Q + R = S in a position, of |n_k| S in a height.

# (1) exact position less the computed one, as  y A + t q B + t m C,  each factor at most `position`
A = e1 - e5;                                    # y: rounded; the sum
B = e2 - ((1 + e4) * (1 + e5) - 1);             # q: rounded; times t; the sum
C = 1 * e3;                                         # m: rounded, for paths given by their end
# |z| in the program's arithmetic, per S
size = 1 + ((1 + e4) * (1 + e5) - 1);
# one term of a height, per |n_k| S: computed, up to three roundings, with |z| <= size; against the exact position
term = position + size * ((1 + e6) * (1 + e7) * (1 + e8) - 1);
# (5) difference of two heights, each |h| <= (1 + term) |n|_1 S, rounded once more
separation = 2 * height + 2 * (1 + height) * e9;
# what the program subtracts, per |n|_1 S: S, |n|_1 (two sums each) and their product computed
subtracted = 16 * 1b-53 * ((1 + f1) * (1 + f2) * (1 + f3) * (1 + f4) * (1 + f5));
# (6) computed over exact: the subtraction, |n| (three roundings under the root: 1 + g1, |g1| <= 1.501 u), the root, the quotient, the product
quotient = (1 + g2) * (1 + g4) * (1 + g5) * (1 - 8b-53) / ((1 + g3) * (1 + g1));
gap = (1 + g6) * (1 + g7) * (1 - 8b-53);
# (7) computed over exact: q, its length (under the root h0), the root, the sum, the product, the last sum
speed = (1 + h1) * (1 + h0) * (1 + h2) * (1 + h3) * (1 + h4) * (1 + h5) * (1 + 16b-53);

{
  |e1| <= 1b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53 /\ |e5| <= 1b-53 /\ |e6| <= 1b-53 /\ |e7| <= 1b-53 /\ |e8| <= 1b-53 /\ |e9| <= 1b-53 /\
  |f1| <= 1b-53 /\ |f2| <= 1b-53 /\ |f3| <= 1b-53 /\ |f4| <= 1b-53 /\ |f5| <= 1b-53 /\
  |g2| <= 1b-53 /\ |g3| <= 1b-53 /\ |g4| <= 1b-53 /\ |g5| <= 1b-53 /\ |g6| <= 1b-53 /\ |g7| <= 1b-53 /\
  |h1| <= 1b-53 /\ |h2| <= 1b-53 /\ |h3| <= 1b-53 /\ |h4| <= 1b-53 /\ |h5| <= 1b-53 /\
  |position| <= 0x3.01p-53 /\ |height| <= 0x6.04p-53 /\
  |g1| <= 0x1.81p-53 /\ |h0| <= 0x1.81p-53
  ->
  |A| <= 3b-53 /\ |B| <= 0x3.01p-53 /\ |C| <= 3b-53 /\ |term| <= 0x6.04p-53 /\
  |separation| <= 0xE.1p-53 /\ subtracted >= 0xE.1p-53 /\ quotient <= 1 /\ gap <= 1 /\ speed >= 1 }
