! SPDX-License-Identifier: BSD-3-Clause
!> Interfaces of the LAPACK routines that are used.
module flexact_lapack
   use flexact_kinds, only: wp
   implicit none
   private
   public :: dgesdd, dgebrd, dbdsqr, dbdsdc, dormbr, dgejsv, dgeqrf, dgeqp3, dorgqr, dtzrzf, dormrz, dgels, dtrtrs
   public :: dsyrk, dpotrf, dtrsm, dgemm, dgemv, dsyevd, dsygv

   interface
      !> Singular value decomposition by divide and conquer; a is destroyed.
      pure subroutine dgesdd(jobz, m, n, a, lda, s, u, ldu, vt, ldvt, work, lwork, iwork, info)
         import :: wp
         character, intent(in) :: jobz
         integer, intent(in) :: m, n, lda, ldu, ldvt, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: s(*)
         real(wp), intent(inout) :: u(ldu, *), vt(ldvt, *), work(*)
         integer, intent(inout) :: iwork(*)
         integer, intent(out) :: info
      end subroutine dgesdd

      !> Reduction to bidiagonal form, in place of a.
      pure subroutine dgebrd(m, n, a, lda, d, e, tauq, taup, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, lda, lwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         real(wp), intent(out) :: d(*), e(*), tauq(*), taup(*)
         integer, intent(out) :: info
      end subroutine dgebrd

      !> Singular values of a bidiagonal matrix, in place of its diagonal, and what was asked of
      !> vectors.
      pure subroutine dbdsqr(uplo, n, ncvt, nru, ncc, d, e, vt, ldvt, u, ldu, c, ldc, work, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, ncvt, nru, ncc, ldvt, ldu, ldc
         real(wp), intent(inout) :: d(*), e(*), vt(ldvt, *), u(ldu, *), c(ldc, *), work(*)
         integer, intent(out) :: info
      end subroutine dbdsqr

      !> The same by divide and conquer, with all vectors.
      pure subroutine dbdsdc(uplo, compq, n, d, e, u, ldu, vt, ldvt, q, iq, work, iwork, info)
         import :: wp
         character, intent(in) :: uplo, compq
         integer, intent(in) :: n, ldu, ldvt
         real(wp), intent(inout) :: d(*), e(*), u(ldu, *), vt(ldvt, *), q(*), work(*)
         integer, intent(inout) :: iq(*), iwork(*)
         integer, intent(out) :: info
      end subroutine dbdsdc

      !> Products with Q or P' of dgebrd, whose a is as before in the end.
      pure subroutine dormbr(vect, side, trans, m, n, k, a, lda, tau, c, ldc, work, lwork, info)
         import :: wp
         character, intent(in) :: vect, side, trans
         integer, intent(in) :: m, n, k, lda, ldc, lwork
         real(wp), intent(in) :: tau(*)
         real(wp), intent(inout) :: a(lda, *), c(ldc, *), work(*)
         integer, intent(out) :: info
      end subroutine dormbr

      !> Singular value decomposition by preconditioned Jacobi rotations for
      !> m >= n; a is destroyed, the values are work(1)/work(2)*sva.
      pure subroutine dgejsv(joba, jobu, jobv, jobr, jobt, jobp, m, n, a, lda, sva, u, ldu, v, ldv, &
                             work, lwork, iwork, info)
         import :: wp
         character, intent(in) :: joba, jobu, jobv, jobr, jobt, jobp
         integer, intent(in) :: m, n, lda, ldu, ldv, lwork
         real(wp), intent(inout) :: a(lda, *)
         real(wp), intent(out) :: sva(*)
         real(wp), intent(inout) :: u(ldu, *), v(ldv, *), work(*)
         integer, intent(inout) :: iwork(*)
         integer, intent(out) :: info
      end subroutine dgejsv

      !> QR factorisation by Householder reflections, in place.
      pure subroutine dgeqrf(m, n, a, lda, tau, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, lda, lwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         real(wp), intent(out) :: tau(*)
         integer, intent(out) :: info
      end subroutine dgeqrf

      !> The first n columns of Q from the reflections of dgeqrf, in place.
      pure subroutine dorgqr(m, n, k, a, lda, tau, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, k, lda, lwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         real(wp), intent(in) :: tau(*)
         integer, intent(out) :: info
      end subroutine dorgqr

      !> QR factorisation with column pivoting, in place; columns with jpvt 0
      !> are free to move.
      pure subroutine dgeqp3(m, n, a, lda, jpvt, tau, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, lda, lwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         integer, intent(inout) :: jpvt(*)
         real(wp), intent(out) :: tau(*)
         integer, intent(out) :: info
      end subroutine dgeqp3

      !> An upper trapezoid (m <= n) as a triangle times orthogonal Z, in place.
      pure subroutine dtzrzf(m, n, a, lda, tau, work, lwork, info)
         import :: wp
         integer, intent(in) :: m, n, lda, lwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         real(wp), intent(out) :: tau(*)
         integer, intent(out) :: info
      end subroutine dtzrzf

      !> c times Z or Z' from the reflections of dtzrzf; a is restored.
      pure subroutine dormrz(side, trans, m, n, k, l, a, lda, tau, c, ldc, work, lwork, info)
         import :: wp
         character, intent(in) :: side, trans
         integer, intent(in) :: m, n, k, l, lda, ldc, lwork
         real(wp), intent(inout) :: a(lda, *), c(ldc, *), work(*)
         real(wp), intent(in) :: tau(*)
         integer, intent(out) :: info
      end subroutine dormrz

      !> Least squares by QR (m >= n), a of full rank; the solution stands in b.
      subroutine dgels(trans, m, n, nrhs, a, lda, b, ldb, work, lwork, info)
         import :: wp
         character, intent(in) :: trans
         integer, intent(in) :: m, n, nrhs, lda, ldb, lwork
         real(wp), intent(inout) :: a(lda, *), b(ldb, *), work(*)
         integer, intent(out) :: info
      end subroutine dgels

      !> Solve with a triangle a, in place.
      pure subroutine dtrtrs(uplo, trans, diag, n, nrhs, a, lda, b, ldb, info)
         import :: wp
         character, intent(in) :: uplo, trans, diag
         integer, intent(in) :: n, nrhs, lda, ldb
         real(wp), intent(in) :: a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
         integer, intent(out) :: info
      end subroutine dtrtrs

      !> c := alpha a'a + beta c (trans 'T') or alpha a a' + beta c (trans 'N'), one triangle.
      pure subroutine dsyrk(uplo, trans, n, k, alpha, a, lda, beta, c, ldc)
         import :: wp
         character, intent(in) :: uplo, trans
         integer, intent(in) :: n, k, lda, ldc
         real(wp), intent(in) :: alpha, beta, a(lda, *)
         real(wp), intent(inout) :: c(ldc, *)
      end subroutine dsyrk

      !> Cholesky factorisation, in place.
      pure subroutine dpotrf(uplo, n, a, lda, info)
         import :: wp
         character, intent(in) :: uplo
         integer, intent(in) :: n, lda
         real(wp), intent(inout) :: a(lda, *)
         integer, intent(out) :: info
      end subroutine dpotrf

      !> b := alpha inverse(op(a)) b (side 'L') or alpha b inverse(op(a)) (side 'R'), a a triangle.
      pure subroutine dtrsm(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb)
         import :: wp
         character, intent(in) :: side, uplo, transa, diag
         integer, intent(in) :: m, n, lda, ldb
         real(wp), intent(in) :: alpha, a(lda, *)
         real(wp), intent(inout) :: b(ldb, *)
      end subroutine dtrsm

      !> c := alpha op(a) op(b) + beta c, op by 'N' as it is, by 'T' transposed.
      pure subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
         import :: wp
         character, intent(in) :: transa, transb
         integer, intent(in) :: m, n, k, lda, ldb, ldc
         real(wp), intent(in) :: alpha, beta, a(lda, *), b(ldb, *)
         real(wp), intent(inout) :: c(ldc, *)
      end subroutine dgemm

      !> y := alpha op(a) x + beta y, op by 'N' as it is, by 'T' transposed.
      pure subroutine dgemv(trans, m, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: wp
         character, intent(in) :: trans
         integer, intent(in) :: m, n, lda, incx, incy
         real(wp), intent(in) :: alpha, beta, a(lda, *), x(*)
         real(wp), intent(inout) :: y(*)
      end subroutine dgemv

      !> Eigenvalues w of a symmetric a, ascending, and eigenvectors in its place.
      pure subroutine dsyevd(jobz, uplo, n, a, lda, w, work, lwork, iwork, liwork, info)
         import :: wp
         character, intent(in) :: jobz, uplo
         integer, intent(in) :: n, lda, lwork, liwork
         real(wp), intent(inout) :: a(lda, *), work(*)
         real(wp), intent(out) :: w(*)
         integer, intent(inout) :: iwork(*)
         integer, intent(out) :: info
      end subroutine dsyevd

      !> The same of a x = w b x (itype 1), b positive definite, which is destroyed.
      pure subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
         import :: wp
         integer, intent(in) :: itype, n, lda, ldb, lwork
         character, intent(in) :: jobz, uplo
         real(wp), intent(inout) :: a(lda, *), b(ldb, *), work(*)
         real(wp), intent(out) :: w(*)
         integer, intent(out) :: info
      end subroutine dsygv
   end interface
end module flexact_lapack
